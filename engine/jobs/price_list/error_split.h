#pragma once

#include <span>
#include <vector>

#include "formats/image.h"

namespace voxilux {

// The noise of a reference, as a square in the units of relMSE, and the interval of 95 % of that square.
struct ReferenceNoise {
    double square = 0.0;
    double low = 0.0;
    double high = 0.0;
};

// The error of pictures of one kind, roots of relMSE against a converged picture.
struct SplitError {
    double total = 0.0;
    double noise = 0.0;     // what other random numbers would change
    double bias = 0.0;      // what they would not; 0 where none was found
    double bias_low = 0.0;  // interval of 95 %
    double bias_high = 0.0;
    bool is_limited = false;      // below kReferenceMargin times the noise of the reference
    std::vector<double> squares;  // relMSE of each picture, less that of the reference's noise
};

// An error is told well where the reference's own noise is so many times smaller.
inline constexpr double kReferenceMargin = 3.0;

// From three or more pictures with independent random numbers (asserted) and a reference of other ones. The
// bias comes from products of two pictures' differences (film/difference_estimate.h), the noise is what is
// left of the mean square; the reference's noise, which is common to all differences, is taken off both.
[[nodiscard]] SplitError split_error(std::span<const Image> pictures, const Image& reference,
                                     const ReferenceNoise& noise);

// relMSE over all pixels.
[[nodiscard]] double relative_square(const Image& picture, const Image& reference);

// Pixels of which a colour has other bits.
[[nodiscard]] std::uint64_t differing_pixels(const Image& a, const Image& b);

}  // namespace voxilux
