#pragma once

#include <span>
#include <vector>

#include "formats/image.h"

namespace voxilux {

// The squared noise of a reference, in the units of relMSE, and its 95 % interval.
struct ReferenceNoise {
    double square = 0.0;
    double low = 0.0;
    double high = 0.0;
};

// The error of images of one kind, as sqrt(relMSE) against a converged image.
struct SplitError {
    double total = 0.0;
    double noise = 0.0;     // varies with the random numbers
    double bias = 0.0;      // does not; 0 where none was found
    double bias_low = 0.0;  // 95 % interval
    double bias_high = 0.0;
    bool is_limited = false;      // below kReferenceMargin times the noise of the reference
    std::vector<double> squares;  // relMSE of each image, minus the squared noise of the reference
};

// An error is reliable where the noise of the reference is this many times smaller.
inline constexpr double kReferenceMargin = 3.0;

// From three or more images with independent random numbers (asserted) and a reference with others. The bias
// comes from products of two images' differences (film/difference_estimate.h); the noise is the rest of the
// mean square. The reference's noise, which is common to all differences, is subtracted from both.
[[nodiscard]] SplitError split_error(std::span<const Image> pictures, const Image& reference,
                                     const ReferenceNoise& noise);

// relMSE over all pixels.
[[nodiscard]] double relative_square(const Image& picture, const Image& reference);

// Pixels in which any colour differs in any bit.
[[nodiscard]] std::uint64_t differing_pixels(const Image& a, const Image& b);

}  // namespace voxilux
