#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "formats/image.h"
#include "shared/limits.h"

namespace voxilux {

// The film sums samples as signed 64-bit fixed point (shared/film_sum.h), a pair of words read back as one
// little-endian integer: 1.0 is 2^kFilmFractionBits. Integer sums are exact, so neither the order of the
// atomics nor the number of samples changes the mean.
using gpu::kFilmFractionBits;

// The samples of one half of the film as read back: the even or the odd ones.
struct FilmHalf {
    std::span<const std::int64_t> rgb;       // [height][width][3] sums
    std::span<const std::uint64_t> samples;  // [height][width] counts, or a single count for every pixel
};

// One pixel of two halves, in radiance.
struct HalfMeans {
    std::array<double, 3> a = {}, b = {};  // sum / count of each half; 0 where it has no samples
    std::array<double, 3> mean = {};       // of all samples
    double weight = 0.0;                   // sqrt(nA nB) / (nA + nB); 0 when a half is empty
};

// sum / (count * 2^kFilmFractionBits), correctly rounded to float; 0 when there are no samples.
[[nodiscard]] float film_mean(std::int64_t sum, std::uint64_t count);

// The means of pixel number `pixel`.
[[nodiscard]] HalfMeans half_means(const FilmHalf& a, const FilmHalf& b, std::size_t pixel);

// Sums of squares of the samples, [height][width][3], fixed point like the sums themselves. They saturate at
// kSquaresFull.
using FilmSquares = std::span<const std::int64_t>;
inline constexpr std::int64_t kSquaresFull = INT64_MAX;

// Variance of the mean of pixel number `pixel` by component, if its samples are independent: (mean of squares
// - square of mean) / (n - 1) for n samples; where the squares are saturated, from the halves: (a - b)^2 nA
// nB / (nA + nB)^2. The square of the mean where there are fewer than two samples.
[[nodiscard]] std::array<double, 3> mean_variance(const FilmHalf& a, const FilmHalf& b, FilmSquares squares,
                                                  std::size_t pixel);

// Asserts that a half holds this many pixels.
void check_half(const FilmHalf& half, std::size_t pixels);

// Beauty R G B (half precision) = (A + B) / (nA + nB); sampleCount.Y = nA + nB; error.Y = standard error of
// the luminance of the beauty, estimated from the halves: |A/nA - B/nB| sqrt(nA nB) / (nA + nB), which for
// equal halves is half their difference. One pixel's value is itself noisy (one degree of freedom); its
// square is unbiased (error_estimate.cpp). Where a half has no samples nothing is known and error.Y is the
// luminance itself.
[[nodiscard]] Image film_image(int width, int height, const FilmHalf& a, const FilmHalf& b);

// Means of one component of interleaved sums: element i is sums[i * stride + offset] over `count` samples.
[[nodiscard]] std::vector<float> mean_plane(std::span<const std::int64_t> sums, std::size_t stride,
                                            std::size_t offset, std::uint64_t count);

}  // namespace voxilux
