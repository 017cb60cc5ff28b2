#pragma once

#include <cmath>
#include <optional>
#include <string>

#include "film/film.h"

namespace voxilux {

inline constexpr double kErrorConfidence = 0.95;
// Normal quantile of intervals, two-sided, at 97 %: their width is itself an estimate, and in the tests,
// which count how often an interval holds the truth, only intervals so wide do so more often than
// kErrorConfidence.
inline constexpr double kClaimQuantile = 2.170090377584560;

// Systematic part of the error, in the units of relMSE: mean over pixels and channels of bias^2 / (radiance^2
// + kRelMseEpsilon), with the standard error of that mean.
struct BiasEstimate {
    double squared = 0.0;  // may be below 0 by noise
    double deviation = 0.0;

    // The upper end of the interval of squared, 0 or above.
    [[nodiscard]] double max_squared() const;
};

// How far the beauty is from the converged one, which is unknown: an estimate of sqrt(relMSE), a relative
// error (0.01 is 1 %), and an interval that holds the true value with the given confidence.
struct ErrorEstimate {
    std::string metric = "relmse-root";
    double estimate = 0.0;
    double low = 0.0;
    double high = 0.0;  // infinity when there are too few pixels or samples to tell
    double confidence = kErrorConfidence;
    // Where the bias is known, too: the two parts of the estimate, whose squares add up to its own.
    std::optional<double> noise;
    std::optional<double> bias;
    std::optional<BiasEstimate> bias_squared;  // what `bias` is the root of, as measured

    [[nodiscard]] bool is_known() const { return !std::isnan(estimate); }
};

// Where nothing can be said: estimate and low are NaN, high is infinite.
[[nodiscard]] ErrorEstimate unknown_error();

// The error of film_image(width, height, a, b) by the two-halves argument (error_estimate.cpp). Needs
// independent halves, as those of record_frame() are. Events that no sample met (a caustic not yet found) are
// invisible to it. With squares, which independent samples allow, the error comes from the variance of each
// pixel, and only the width of the interval from the halves: the estimate itself scatters less.
[[nodiscard]] ErrorEstimate estimate_error(int width, int height, const FilmHalf& a, const FilmHalf& b,
                                           FilmSquares squares = {});

}  // namespace voxilux
