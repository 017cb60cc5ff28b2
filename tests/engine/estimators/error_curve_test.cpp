#include "estimators/error_curve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

namespace voxilux {
namespace {

constexpr double kAlpha = 2.0 / 3.0;
constexpr ErrorLaw kIndependent{.noise = NoiseLaw::independent};
constexpr ErrorLaw kSequence{.noise = NoiseLaw::sequence};
constexpr ErrorLaw kPhotons{.noise = NoiseLaw::photons, .alpha = kAlpha};
constexpr double kSpread = 1.2;  // noise_high over noise

using Noise = std::function<double(double samples)>;

// Estimated errors of a film whose noise is known, at 4, 8, ... `most` samples, each off by a factor
// exp(normal * scatter).
std::vector<ErrorPoint> points_of(const Noise& noise, double most, double scatter = 0.0,
                                  std::uint32_t seed = 1) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    std::vector<ErrorPoint> points;
    for (double n = 4.0; n <= most; n *= 2.0) {
        const double claimed = noise(n) * std::exp(scatter * normal(random));
        points.push_back({.samples = n, .noise = claimed, .noise_high = kSpread * claimed});
    }
    return points;
}

// Sums of the form (v0 + v1 mean of i^(1/3)) / n.
double photon_noise(double n) {
    double sum = 0.0;
    for (double i = 1.0; i <= n; i += 1.0)
        sum += std::cbrt(i);
    return (0.4 + 0.6 * sum / n) / n;
}

double predicted_noise(const ErrorLaw& law, const std::vector<ErrorPoint>& points, double samples) {
    const double error = expected_error(fit_error(law, points).value(), samples);
    return error * error;
}

TEST(MeanPower, sums_are_those_of_a_loop) {
    for (const double power : {-1.0, -1.0 / 3.0, 0.0, 1.0 / 3.0, 1.0}) {
        for (const double n : {1.0, 2.0, 64.0, 65.0, 1000.0}) {
            double sum = 0.0;
            for (double i = 1.0; i <= n; i += 1.0)
                sum += std::pow(i, power);
            EXPECT_NEAR(mean_power(n, power) / (sum / n), 1.0, 1e-5) << n << " " << power;
        }
    }
}

TEST(ErrorCurve, independent_samples_need_the_square_of_the_error) {
    const auto points = points_of([](double n) { return 0.09 / n; }, 16);
    const ErrorCurve curve = fit_error(kIndependent, points).value();
    EXPECT_NEAR(claimed_error(curve, 900.0), std::sqrt(kSpread * 1e-4), 1e-9);
    EXPECT_NEAR(expected_error(curve, 900.0), 0.01, 1e-9);
    EXPECT_NEAR(samples_for(curve, 0.01).value(), kSpread * 900.0, 1.0);
    EXPECT_NEAR(samples_for(curve, 0.005).value(), 4.0 * kSpread * 900.0, 1.0);
}

TEST(ErrorCurve, photons_are_extrapolated_to_fifty_times_as_many) {
    const double found = predicted_noise(kPhotons, points_of(photon_noise, 64), 3200.0);
    EXPECT_NEAR(found / photon_noise(3200.0), 1.0, 0.08);
}

TEST(ErrorCurve, photons_taken_for_independent_samples_are_far_off) {
    const double found = predicted_noise(kIndependent, points_of(photon_noise, 64), 3200.0);
    EXPECT_LT(found / photon_noise(3200.0), 0.6);
}

// Edges in two and in four dimensions, whose noise falls as n^-1.5 and n^-1.25.
double sequence_noise(double n) {
    return 0.3 * std::pow(n, -1.5) + 0.05 * std::pow(n, -1.25);
}

TEST(ErrorCurve, sequence_between_its_two_laws_is_followed) {
    const double found = predicted_noise(kSequence, points_of(sequence_noise, 64), 1000.0);
    EXPECT_NEAR(found / sequence_noise(1000.0), 1.0, 0.1);
}

TEST(ErrorCurve, sequence_taken_for_independent_samples_is_far_off) {
    const double found = predicted_noise(kIndependent, points_of(sequence_noise, 64), 1000.0);
    EXPECT_GT(found / sequence_noise(1000.0), 2.0);
}

// Over many sets of estimates that each scatter by 6 %, the interval meant for 80 % holds the truth about as
// often; one of half the width does not.
double share_held(double deviations) {
    int held = 0;
    constexpr int kTrials = 400;
    for (int trial = 0; trial < kTrials; ++trial) {
        const auto points = points_of(photon_noise, 32, 0.06, static_cast<std::uint32_t>(trial));
        const ErrorCurve curve = fit_error(kPhotons, points).value();
        const double truth = std::sqrt(kSpread * photon_noise(1000.0));
        if (claimed_error(curve, 1000.0, -deviations) <= truth &&
            truth <= claimed_error(curve, 1000.0, deviations))
            ++held;
    }
    return static_cast<double>(held) / kTrials;
}

TEST(ErrorCurve, interval_of_noisy_claims_holds_the_truth) {
    EXPECT_GE(share_held(1.28), 0.78);
}

TEST(ErrorCurve, interval_that_is_too_narrow_is_caught) {
    EXPECT_LT(share_held(0.25), 0.7);
}

TEST(ErrorCurve, bias_falls_with_the_disc) {
    constexpr ErrorLaw kBiased{.noise = NoiseLaw::photons, .alpha = kAlpha, .has_bias = true};
    std::vector<ErrorPoint> points = points_of(photon_noise, 64);
    for (ErrorPoint& point : points) {
        point.bias = 0.02 * std::pow(point.samples, -0.5);
        point.bias_deviation = 0.0002;
    }
    const ErrorCurve curve = fit_error(kBiased, points).value();
    EXPECT_NEAR(expected_bias(curve, 1000.0) / std::sqrt(0.02 * std::pow(1000.0, -0.5)), 1.0, 0.15);
    EXPECT_GT(claimed_error(curve, 1000.0), std::sqrt(kSpread * photon_noise(1000.0)));
}

TEST(ErrorCurve, bias_of_a_radius_that_stays_puts_small_errors_out_of_reach) {
    constexpr ErrorLaw kStays{.noise = NoiseLaw::photons, .alpha = 1.0, .has_bias = true};
    std::vector<ErrorPoint> points = points_of([](double n) { return 0.09 / n; }, 16);
    for (ErrorPoint& point : points) {
        point.bias = 1e-4;
        point.bias_deviation = 1e-6;
    }
    const ErrorCurve curve = fit_error(kStays, points).value();
    EXPECT_FALSE(samples_for(curve, 0.009));
    EXPECT_TRUE(samples_for(curve, 0.02));
}

// Errors that renders of scenes/cornell.toml on 128 x 128 pixels estimated with two seeds: means of the
// noise.
TEST(ErrorCurve, cornell_box_is_foretold_from_a_tenth_of_its_samples) {
    const std::vector<ErrorPoint> points = {
        {.samples = 8, .noise = 0.02923, .noise_high = 0.0566},
        {.samples = 16, .noise = 0.01469, .noise_high = 0.0235},
        {.samples = 32, .noise = 0.00772, .noise_high = 0.0107},
        {.samples = 64, .noise = 0.00428, .noise_high = 0.00567},
    };
    EXPECT_NEAR(predicted_noise(kPhotons, points, 512.0) / 0.000701, 1.0, 0.15);
}

TEST(ErrorCurve, nothing_measured_gives_no_curve) {
    EXPECT_FALSE(fit_error(kSequence, {}));
    const std::vector<ErrorPoint> silent = {{.samples = 4, .noise = 0.0, .noise_high = 0.0}};
    EXPECT_FALSE(fit_error(kSequence, silent));
    EXPECT_FALSE(error_point(4.0, unknown_error()));
    EXPECT_FALSE(error_point(4.0, {.estimate = 0.1, .low = 0.05, .high = INFINITY}));
}

TEST(ErrorPoint, bias_is_taken_out_of_the_upper_end) {
    const ErrorEstimate estimate = {.estimate = 0.05,
                                    .low = 0.04,
                                    .high = 0.1,
                                    .noise = 0.04,
                                    .bias = 0.03,
                                    .bias_squared = BiasEstimate{.squared = 0.0009, .deviation = 0.001}};
    const ErrorPoint point = error_point(8.0, estimate).value();
    EXPECT_NEAR(point.noise, 0.0016, 1e-12);
    EXPECT_NEAR(point.noise_high, 0.01 - 0.0009 - 1.6449 * 0.001, 1e-6);
    EXPECT_EQ(point.bias, 0.0009);
}

}  // namespace
}  // namespace voxilux
