#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "formats/image.h"

namespace voxilux {

inline constexpr double kRelMseEpsilon =
    0.01;                                      // radiance squared; bounds relMSE where the reference is black
inline constexpr double kSmapeEpsilon = 0.01;  // radiance; the same for SMAPE
inline constexpr double kTrimmedShare = 0.001;  // fraction of the worst pixels that trimmed relMSE leaves out
inline constexpr double kPsnrPeak = 1.0;        // radiance of display white

// Which pixels are compared: those of the box where the mask is not black.
struct Selection {
    std::optional<PixelBox> box;
    const Image* mask = nullptr;  // not owned; R G B or Y, the size of the images
};

// Over the selected pixels and the three colour channels, in linear light; x test, r reference.
struct Metrics {
    double rmse = 0.0;            // sqrt(mean((x-r)^2))
    double mae = 0.0;             // mean(|x-r|)
    double relmse = 0.0;          // mean((x-r)^2 / (r^2 + kRelMseEpsilon))
    double trimmed_relmse = 0.0;  // as relmse, without the kTrimmedShare worst pixels
    double smape = 0.0;           // mean(2|x-r| / (|x| + |r| + kSmapeEpsilon))
    std::optional<double> psnr;   // 20 log10(kPsnrPeak / rmse) in dB; empty when the images are equal
    double max_abs = 0.0;         // max(|x-r|)
    std::array<double, 3> mean_ref = {};
    std::array<double, 3> mean_test = {};
    std::uint64_t pixels = 0;  // compared
    std::uint64_t non_finite =
        0;  // of these, pixels with a NaN or infinity in either image: every metric is then NaN
};

// The indices of the selected pixels in rising order. Throws Error(input_refused) when the mask has another
// size or no colour, the box leaves the image, or nothing is left to compare.
[[nodiscard]] std::vector<std::size_t> selected_pixels(int width, int height, const Selection& selection);

// The metrics of two images of one size over these pixels. Sums are compensated doubles in pixel order: the
// same input gives the same bits. Throws Error(input_refused) when sizes differ or colours are missing.
[[nodiscard]] Metrics measure_difference(const Image& reference, const Image& test,
                                         const std::vector<std::size_t>& pixels);

}  // namespace voxilux
