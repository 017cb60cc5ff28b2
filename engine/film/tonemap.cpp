#include "film/tonemap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/assert.h"
#include "base/colour.h"
#include "shared/tone_curve.h"

namespace voxilux {
namespace {

void count(float value, DisplayImage& display) {
    if (std::isnan(value)) {
        ++display.nan;
    } else if (std::isinf(value)) {
        ++display.infinite;
    } else if (value < 0.0f) {
        ++display.negative;
    }
}

}  // namespace

float tone_map(float linear, ToneMap curve) {
    if (!(linear > 0.0f)) return 0.0f;
    return curve == ToneMap::filmic ? gpu::filmic_curve(linear) : std::min(linear, 1.0f);
}

float automatic_exposure_ev(const Image& image) {
    constexpr double kMiddleGrey = 0.18;
    const auto planes = colour_planes(image);
    VX_ASSERT(planes.has_value());
    double stops = 0.0, count = 0.0;
    for (std::size_t i = 0; i < (*planes)[0].size(); ++i) {
        const double light =
            luminance(std::array<double, 3>{(*planes)[0][i], (*planes)[1][i], (*planes)[2][i]});
        if (!(light > 0.0) || std::isinf(light)) continue;
        stops += std::log2(light);
        count += 1.0;
    }
    return count > 0.0 ? static_cast<float>(std::log2(kMiddleGrey) - stops / count) : 0.0f;
}

DisplayImage to_display(const Image& image, const ToneMapOptions& options) {
    const auto planes = colour_planes(image);
    VX_ASSERT(planes.has_value());
    const std::array<std::string, 3> names = {"R", "G", "B"};
    DisplayImage display{.image = make_image(image.width, image.height, names)};
    display.image.display_referred = true;
    const float ev = options.exposure_ev ? *options.exposure_ev : automatic_exposure_ev(image);
    const float scale = std::min(std::exp2(ev), std::numeric_limits<float>::max());
    const std::array<float, 256> decoded = decoded_srgb_codes();
    const std::array<float, 3> magenta = {1.0f, 0.0f, 1.0f};
    for (std::size_t c = 0; c < names.size(); ++c) {
        std::vector<float>& shown = display.image.channels[names[c]].pixels;
        for (std::size_t i = 0; i < shown.size(); ++i) {
            const float value = (*planes)[c][i];
            count(value, display);
            const bool has_nan =
                options.debug_nan &&
                (std::isnan((*planes)[0][i]) || std::isnan((*planes)[1][i]) || std::isnan((*planes)[2][i]));
            shown[i] = has_nan ? magenta[c] : decoded[srgb_code(tone_map(value * scale, options.curve))];
        }
    }
    return display;
}

}  // namespace voxilux
