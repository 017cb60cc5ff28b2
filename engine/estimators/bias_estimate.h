#pragma once

#include <cstdint>
#include <span>

#include "estimators/error_estimate.h"
#include "film/film.h"

namespace voxilux {

// Pixels along the edge of a block whose sum counts as one draw: wider than photon discs in common images.
inline constexpr int kBlockEdge = 16;

// From the biases that the samples of two independent halves tell, [height][width][3] sums like those of the
// beauty and of the same samples. The product of two independent estimates is an unbiased one of the square;
// its scatter is taken from blocks of pixels, because neighbours share photons.
[[nodiscard]] BiasEstimate estimate_bias(int width, int height, const FilmHalf& beauty_a,
                                         const FilmHalf& beauty_b, std::span<const std::int64_t> bias_a,
                                         std::span<const std::int64_t> bias_b);

// A larger interval around a larger estimate: what noise and bias add up to.
[[nodiscard]] ErrorEstimate with_bias(ErrorEstimate noise, const BiasEstimate& bias);

}  // namespace voxilux
