#pragma once

#include <cstdint>
#include <optional>

#include <glm/glm.hpp>

#include "formats/image.h"

namespace voxilux {

enum class ToneMap : std::uint8_t { plain, filmic };

struct ToneMapOptions {
    ToneMap curve = ToneMap::filmic;
    std::optional<float> exposure_ev =
        0.0f;                             // stops: colours are multiplied by 2^exposure_ev; none: automatic
    bool is_exposure_given = false;       // by the user, which overrides that of the scene
    std::optional<glm::vec3> background;  // linear; composited behind an image with A
    bool debug_nan = false;               // a pixel with a NaN becomes magenta instead of black
};

// An image for the screen, and how many values it cannot show.
struct DisplayImage {
    Image image;                 // R G B, display_referred
    std::uint64_t nan = 0;       // values, shown as 0
    std::uint64_t infinite = 0;  // values, shown as 1 (+inf) or 0 (-inf)
    std::uint64_t negative = 0;  // finite values, shown as 0
};

// The curve in linear light: any float in, [0,1] out, monotonic; NaN gives 0. plain clamps. filmic is the
// rational fit of the ACES reference by K. Narkowicz, "ACES Filmic Tone Mapping Curve" (2016), with its
// pre-exposure of 0.6.
[[nodiscard]] float tone_map(float linear, ToneMap curve);

// The exposure in stops that shows the geometric mean of the luminances of an image as middle grey, 0.18
// (Reinhard et al. 2002, "Photographic Tone Reproduction for Digital Images", section 3). Pixels that are
// black or not finite do not count; without others it is 0. Needs R G B or Y (asserted).
[[nodiscard]] float automatic_exposure_ev(const Image& image);

// Exposes, tone maps and rounds to 8-bit sRGB codes; the result holds their decoded values, so write_png
// stores just these codes. Needs R G B or Y (asserted). An image with A has premultiplied colours. The result
// then has straight colours and A, or is composited over the background in sRGB codes, as browsers and paint
// programs do.
[[nodiscard]] DisplayImage to_display(const Image& image, const ToneMapOptions& options = {});

}  // namespace voxilux
