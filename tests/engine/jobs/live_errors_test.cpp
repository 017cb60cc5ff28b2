#include "jobs/live_errors.h"

#include <gtest/gtest.h>

#include <cmath>

namespace voxilux {
namespace {

// An error of noise alone that falls with the root of the samples, from 40 % after one.
ErrorEstimate claim_after(std::uint32_t samples) {
    const double error = 0.4 / std::sqrt(samples);
    return {.estimate = error, .low = 0.95 * error, .high = 1.05 * error};
}

// Takes samples of a tenth of a second each, until `end` or the target.
std::uint32_t watch(LiveErrors& errors, std::uint32_t end) {
    errors.start({.noise = NoiseLaw::independent});
    for (std::uint32_t samples = 1; samples <= end; ++samples) {
        errors.add_time(0.1);
        if (errors.is_due(samples)) errors.add(samples, claim_after(samples));
        if (errors.has_reached_target()) return samples;
    }
    return end;
}

TEST(LiveErrors, looks_when_samples_have_doubled) {
    LiveErrors errors;
    watch(errors, 100);
    std::vector<std::uint32_t> looks;
    for (const LiveError& point : errors.points())
        looks.push_back(point.samples);
    EXPECT_EQ(looks, (std::vector<std::uint32_t>{4, 8, 16, 32, 64}));
    EXPECT_DOUBLE_EQ(errors.points().back().error, 0.05);
    EXPECT_NEAR(errors.points().back().seconds, 6.4, 1e-9);
}

TEST(LiveErrors, forecast_is_that_of_the_law) {
    LiveErrors errors;
    watch(errors, 64);
    // The target is compared with the upper end of the interval: 1.05 * 0.4 / sqrt(n) <= 0.01 from n = 1764
    // on.
    EXPECT_NEAR(*errors.samples_until(0.01), 1764, 2);
    EXPECT_NEAR(*errors.seconds_until(0.01), 176.4 - 6.4, 0.3);
    EXPECT_NEAR(*errors.expected(1600), 0.01, 1e-6);
    EXPECT_FALSE(errors.seconds_until(1e-9)) << "more samples than a film holds";
}

TEST(LiveErrors, target_is_looked_at_when_it_may_be_reached) {
    LiveErrors errors;
    errors.set_target(0.031);
    // (1.05 * 0.4 / 0.031)^2 = 183.6, between two doublings.
    EXPECT_EQ(watch(errors, 1000), 184u);
    EXPECT_TRUE(errors.has_reached_target());
}

TEST(LiveErrors, start_forgets_the_film_but_not_the_target) {
    LiveErrors errors;
    errors.set_target(0.2);
    watch(errors, 100);
    errors.start({});
    EXPECT_TRUE(errors.points().empty());
    EXPECT_FALSE(errors.has_reached_target());
    EXPECT_FALSE(errors.expected(10));
    EXPECT_LT(watch(errors, 1000), 10u);
}

}  // namespace
}  // namespace voxilux
