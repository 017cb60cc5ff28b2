#pragma once

#include <array>
#include <string>
#include <vector>

#include "estimators/error_estimate.h"
#include "film/film_sums.h"
#include "formats/image.h"
#include "passes/denoise/denoise.h"
#include "vk/executor.h"

namespace voxilux {

// A denoised image and its own error estimate.
struct Denoised {
    std::array<std::vector<float>, 3> rgb;  // empty where nothing was filtered
    std::vector<float> error;               // standard error of the luminance, smoothed over some pixels
    ErrorEstimate claim = unknown_error();  // of the image that is written
    std::string reason;                     // why the image was left undenoised; else empty
    std::vector<PassTime> passes;

    [[nodiscard]] bool is_filtered() const { return reason.empty(); }
};

// Whether a film has what the denoiser needs: the sums of a plan with `sums_guides`.
[[nodiscard]] bool has_guides(const FilmSums& film);

inline constexpr const char* kNoHalves = "it takes samples with even and with odd numbers";

// Denoises a whole film that has guides, in strips (denoise_strips). The undenoised image stays where a half
// has no samples, or where the denoised one has the larger estimated error.
[[nodiscard]] Denoised denoise_film(const FilmSums& film, Executor& executor,
                                    std::size_t strip_pixels = kDenoiseStripPixels);

// Adds denoised.R .G .B and denoised.error.Y to an image of the film.
void add_denoised(const Denoised& denoised, Image& image);

// What a PNG shows: the image with the denoised colours.
[[nodiscard]] Image shown_picture(const Denoised& denoised, const Image& image);

}  // namespace voxilux
