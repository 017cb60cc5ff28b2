#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "film/image.h"

namespace voxilux {

// The film sums samples as signed 64-bit fixed point: 1.0 is 2^kFilmFractionBits. Integer sums are exact, so
// neither the order of the atomics nor the number of samples changes the mean. Room: sums up to 2^39 in
// magnitude.
inline constexpr int kFilmFractionBits = 24;

// The nearest fixed-point number of a sample, ties away from zero. Needs a finite |value| < 2^39 (asserted).
[[nodiscard]] std::int64_t to_film_fixed(double value);

// sum / (count * 2^kFilmFractionBits), correctly rounded to float; 0 when there are no samples.
[[nodiscard]] float film_mean(std::int64_t sum, std::uint64_t count);

// The samples of one half of the film as read back: the even or the odd ones.
struct FilmHalf {
    std::span<const std::int64_t> rgb;       // [height][width][3] sums
    std::span<const std::uint64_t> samples;  // [height][width] counts, or a single count for every pixel
};

// Beauty R G B (half precision) = (A + B) / (nA + nB); sampleCount.Y = nA + nB; error.Y = standard error of
// the luminance of the beauty, estimated from the halves: |A/nA - B/nB| sqrt(nA nB) / (nA + nB), which for
// equal halves is half their difference. One pixel's value is itself noisy (one degree of freedom); its
// square is unbiased. Where a half has no samples nothing is known and error.Y is the luminance itself.
[[nodiscard]] Image film_image(int width, int height, const FilmHalf& a, const FilmHalf& b);

// Means of one component of interleaved sums: element i is sums[i * stride + offset] over `count` samples.
[[nodiscard]] std::vector<float> mean_plane(std::span<const std::int64_t> sums, std::size_t stride,
                                            std::size_t offset, std::uint64_t count);

inline constexpr double kErrorConfidence = 0.95;

// How far the beauty is from the converged one, without knowing that: estimate of sqrt(relMSE), a relative
// error (0.01 is 1 %), and an interval that holds the true value with the given confidence.
struct ErrorEstimate {
    std::string metric = "relmse-root";
    double estimate = 0.0;
    double low = 0.0;
    double high = 0.0;  // infinity when there are too few pixels or samples to tell
    double confidence = kErrorConfidence;
};

// The error of film_image(width, height, a, b) by the two-halves argument (film.cpp). Holds for independent
// halves; low-discrepancy halves disagree more than their mean errs, so the estimate is then too high, never
// too low. Events that no sample met (a caustic not yet found) are invisible to it.
[[nodiscard]] ErrorEstimate estimate_error(int width, int height, const FilmHalf& a, const FilmHalf& b);

}  // namespace voxilux
