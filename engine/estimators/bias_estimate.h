#pragma once

#include <cstdint>
#include <span>

#include "estimators/error_estimate.h"
#include "film/film.h"

namespace voxilux {

// Pixels along the edge of a block whose sum counts as one draw: wider than the kernels of photons in common
// images.
inline constexpr int kBlockEdge = 16;

// Estimates the bias from those of two independent halves: [height][width][3] sums like those of the beauty,
// over the same samples. The product of two independent estimates is an unbiased estimate of the square. Its
// deviation comes from blocks of pixels, because neighbours share photons.
[[nodiscard]] BiasEstimate estimate_bias(int width, int height, const FilmHalf& beauty_a,
                                         const FilmHalf& beauty_b, std::span<const std::int64_t> bias_a,
                                         std::span<const std::int64_t> bias_b);

// The sum of noise and bias: a larger estimate in a wider interval.
[[nodiscard]] ErrorEstimate with_bias(ErrorEstimate noise, const BiasEstimate& bias);

}  // namespace voxilux
