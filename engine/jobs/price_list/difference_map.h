#pragma once

#include <array>

#include "formats/image.h"

namespace voxilux {

// What the colours of a difference map mean, for people.
inline constexpr const char* kDifferenceScale =
    "relative difference of each pixel, logarithmic: black 0.1 % or less, purple 0.6 %, red 3 %, orange 18 "
    "%, "
    "pale yellow 100 % or more";

// The map of |x - r| / sqrt(r^2 + kRelMseEpsilon), RMS over the colour channels, from 0.1 % to 100 % on a
// logarithmic scale that is the same for all images. Ready for write_png.
[[nodiscard]] Image difference_map(const Image& picture, const Image& reference);

// The colour of a relative difference, 8-bit sRGB codes.
[[nodiscard]] std::array<int, 3> difference_colour(double difference);

}  // namespace voxilux
