#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "estimators/error_estimate.h"

namespace voxilux::test {

// The noise of the samples of a synthetic picture.
enum class NoiseKind { gauss, ambient_occlusion, firefly, decay };

[[nodiscard]] inline const char* name_of(NoiseKind kind) {
    constexpr const char* kNames[] = {"gauss", "ambient occlusion", "firefly", "decay"};
    return kNames[static_cast<int>(kind)];
}

// How often an interval of estimate_error() held the error that it estimated, over many trials.
struct IntervalCoverage {
    int trials = 0;
    int covered = 0;
    int above = 0;  // the truth is worse than the interval says
    double widths = 0.0, ratios = 0.0, estimates = 0.0, squares = 0.0;

    void add(const ErrorEstimate& claimed, double truth) {
        ++trials;
        covered += claimed.low <= truth && truth <= claimed.high ? 1 : 0;
        above += truth > claimed.high ? 1 : 0;
        widths += claimed.high / claimed.low;
        ratios += claimed.estimate / truth;
        estimates += claimed.estimate;
        squares += claimed.estimate * claimed.estimate;
    }

    // Mean of high / low.
    [[nodiscard]] double width() const { return widths / trials; }
    // Mean of estimate / truth.
    [[nodiscard]] double ratio() const { return ratios / trials; }
    // Standard deviation of the estimate, relative to its mean.
    [[nodiscard]] double spread() const {
        const double mean = estimates / trials;
        return std::sqrt(std::max(squares / trials - mean * mean, 0.0)) / mean;
    }
};

inline void expect_honest(const IntervalCoverage& coverage) {
    EXPECT_GE(coverage.covered, static_cast<int>(kErrorConfidence * coverage.trials));
    EXPECT_LE(coverage.above, coverage.trials / 40);  // the side that matters: half of 5 %
    EXPECT_LT(coverage.width(), 3.0);                 // an interval that is wide enough covers anything
    EXPECT_GT(coverage.ratio(), 0.97);
    EXPECT_LT(coverage.ratio(), 1.25);
    testing::Test::RecordProperty("covered", coverage.covered);
    testing::Test::RecordProperty("above", coverage.above);
    testing::Test::RecordProperty("width_percent", static_cast<int>(100 * coverage.width()));
    testing::Test::RecordProperty("ratio_percent", static_cast<int>(100 * coverage.ratio()));
}

}  // namespace voxilux::test
