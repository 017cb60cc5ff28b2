#include "jobs/forecast.h"

#include <gtest/gtest.h>

#include <cmath>

#include "jobs/error_rounds.h"
#include "jobs/forecast_report.h"
#include "jobs/progress_estimate.h"

namespace voxilux {
namespace {

constexpr double kSpread = 1.1;

// A pilot of independent samples that take `sample_s` each, with relMSE 0.09 / n.
ErrorPilot calm_pilot(double sample_s) {
    ErrorPilot pilot{.samples = 32, .film_s = 0.01};
    for (double n = 4.0; n <= 32.0; n *= 2.0)
        pilot.points.push_back({.samples = n, .noise = 0.09 / n, .noise_high = kSpread * 0.09 / n});
    for (double n = 2.0; n <= 32.0; n += 1.0)
        pilot.times.push_back({n, sample_s});
    return pilot;
}

TEST(Forecast, time_is_that_of_the_samples_and_the_pilot) {
    const Forecast forecast = make_forecast(calm_pilot(0.02), 0.01, {.pilot_s = 1.0}).value();
    EXPECT_TRUE(forecast.is_reachable);
    const double least = kSpread * 900.0;
    EXPECT_GE(forecast.samples, least);
    EXPECT_LE(forecast.samples, 1.15 * least);
    EXPECT_NEAR(forecast.expected_s, 1.0 + 0.02 * forecast.samples, 0.1);
    EXPECT_LT(forecast.low_s, forecast.expected_s);
    EXPECT_GT(forecast.high_s, forecast.expected_s);
    EXPECT_LE(forecast.claimed, 0.01);
}

TEST(Forecast, machine_that_changes_its_pace_widens_the_interval) {
    ErrorPilot uneven = calm_pilot(0.02);
    for (std::size_t i = 0; i < uneven.times.size() / 2; ++i)
        uneven.times[i].seconds *= 2.0;
    const Forecast wide = make_forecast(uneven, 0.01, {}).value();
    const Forecast narrow = make_forecast(calm_pilot(0.02), 0.01, {}).value();
    EXPECT_GT(wide.high_s / wide.low_s, 1.5 * narrow.high_s / narrow.low_s);
}

TEST(Forecast, discs_that_shrink_make_later_samples_cheaper) {
    const ErrorLaw law{.noise = NoiseLaw::photons, .alpha = 2.0 / 3.0};
    std::vector<SampleTime> times;
    double whole = 0.0;
    for (double n = 1.0; n <= 1000.0; n += 1.0) {
        const double seconds = 0.01 + 0.03 * std::pow(n, -1.0 / 3.0);
        whole += seconds;
        if (n <= 16.0 || n >= 999.0) times.push_back({n, seconds});
    }
    const TimeCurve curve = fit_times(law, times);
    EXPECT_NEAR(1000.0 * curve.mean_of(1000.0) / whole, 1.0, 0.01);
    const TimeCurve blind = fit_times({.noise = NoiseLaw::independent}, times);
    EXPECT_GT(1000.0 * blind.mean_of(1000.0) / whole, 1.3);
}

TEST(Forecast, samples_allowed_bound_it) {
    const Forecast forecast = make_forecast(calm_pilot(0.02), 0.01, {.max_samples = 100}).value();
    EXPECT_FALSE(forecast.is_reachable);
    EXPECT_EQ(forecast.samples, 100u);
    EXPECT_EQ(forecast.reason, "it needs more than the 100 samples allowed");
    EXPECT_GT(forecast.claimed, 0.01);
    EXPECT_NEAR(forecast.expected_s, 2.0, 0.1);
}

TEST(Forecast, samples_of_a_checkpoint_take_no_time) {
    const Forecast whole = make_forecast(calm_pilot(0.02), 0.01, {}).value();
    const Forecast rest = make_forecast(calm_pilot(0.02), 0.01, {.samples_done = 500}).value();
    EXPECT_EQ(rest.samples, whole.samples);
    EXPECT_NEAR(whole.expected_s - rest.expected_s, 500 * 0.02, 1e-9);
}

TEST(Forecast, time_limit_bounds_it) {
    const Forecast forecast = make_forecast(calm_pilot(0.02), 0.01, {.time_limit_s = 5.0}).value();
    EXPECT_EQ(forecast.high_s, 5.0);
    EXPECT_EQ(forecast.low_s, 5.0);
}

TEST(Forecast, pilot_that_saw_nothing_says_nothing) {
    EXPECT_FALSE(make_forecast(ErrorPilot{}, 0.01, {}));
}

TEST(ErrorPilot, ends_with_a_share_of_the_render_or_a_second_of_work) {
    EXPECT_TRUE(doubles_pilot(4, 1e9, 0.0));     // the minimum
    EXPECT_FALSE(doubles_pilot(8, 1e6, 200.0));  // work is done, 16 are more than 2 %
    EXPECT_TRUE(doubles_pilot(8, 1e6, 1000.0));  // 16 of 1000
    EXPECT_TRUE(doubles_pilot(8, 1e4, 200.0));   // little work
    EXPECT_FALSE(doubles_pilot(8, 1e2, 10.0));   // the render itself is no larger
    EXPECT_FALSE(doubles_pilot(256, 1.0, 1e6));  // the maximum
}

ErrorEstimate claim_of(double high) {
    return {.estimate = high / 1.05, .low = high / 1.1, .high = high};
}

TEST(ErrorRounds, pilot_decides_one_round) {
    const ErrorPilot pilot = calm_pilot(0.02);
    ErrorRounds rounds(pilot.law, 0.01, {.points = pilot.points}, 65536, 0);
    EXPECT_EQ(rounds.end(), make_forecast(pilot, 0.01, {}).value().samples);
    EXPECT_TRUE(rounds.reaches(rounds.end(), claim_of(0.0099)));
    EXPECT_EQ(rounds.decided_by(), DecidedBy::pilot);
    EXPECT_EQ(rounds.rounds(), 1u);
}

TEST(ErrorRounds, claim_above_the_target_asks_for_as_much_as_it_lacks) {
    const ErrorPilot pilot = calm_pilot(0.02);
    ErrorRounds rounds(pilot.law, 0.01, {.points = pilot.points}, 65536, 0);
    const std::uint32_t first = rounds.end();
    EXPECT_FALSE(rounds.reaches(first, claim_of(0.0102)));
    EXPECT_GE(rounds.end(), 1.04 * first);
    EXPECT_LE(rounds.end(), 1.5 * first);
    EXPECT_EQ(rounds.rounds(), 2u);
    EXPECT_EQ(rounds.decided_by(), DecidedBy::averaged);
    EXPECT_TRUE(rounds.reaches(rounds.end(), claim_of(0.0098)));
}

TEST(ErrorRounds, without_a_guess_its_own_samples_decide) {
    ErrorRounds rounds({}, 0.01, {}, 65536, 0);
    EXPECT_EQ(rounds.end(), 8u);
    EXPECT_EQ(rounds.decided_by(), DecidedBy::averaged);
    EXPECT_FALSE(rounds.reaches(8, claim_of(0.1)));
    EXPECT_EQ(rounds.end(), 64u);  // eight times as many, although eight samples suggest more
}

TEST(ErrorRounds, claim_that_one_bright_sample_may_have_made_doubles_at_most) {
    const ErrorPilot pilot = calm_pilot(0.02);
    ErrorRounds rounds(pilot.law, 0.01, {.points = pilot.points}, 65536, 0);
    const std::uint32_t first = rounds.end();
    EXPECT_FALSE(rounds.reaches(first, claim_of(0.05)));
    EXPECT_EQ(rounds.end(), 2 * first);
}

TEST(ErrorRounds, samples_allowed_are_the_last) {
    ErrorRounds rounds({}, 0.01, {}, 20, 0);
    EXPECT_FALSE(rounds.reaches(8, claim_of(0.1)));
    EXPECT_EQ(rounds.end(), 20u);
    EXPECT_FALSE(rounds.reaches(20, claim_of(0.06)));
    EXPECT_EQ(rounds.rounds(), 2u);
}

TEST(ErrorRounds, samples_of_a_checkpoint_count) {
    const ErrorPilot pilot = calm_pilot(0.02);
    EXPECT_EQ(ErrorRounds(pilot.law, 0.01, {.points = pilot.points}, 65536, 5000).end(), 5000u);
}

TEST(ProgressEstimate, time_left_is_between_the_two_paces) {
    const RemainingTime rest = estimate_remaining({.samples = 25.0,
                                                   .end = 100.0,
                                                   .end_high = 120.0,
                                                   .sampling_s = 50.0,
                                                   .recent_s = 1.0,
                                                   .end_s = 3.0});
    EXPECT_EQ(rest.done, 0.25);
    EXPECT_NEAR(rest.expected_s, 153.0, 1e-9);
    EXPECT_NEAR(rest.low_s, 75.0 * 0.95 + 3.0, 1e-9);
    EXPECT_NEAR(rest.high_s, 95.0 * 2.0 * 1.05 + 3.0, 1e-9);
}

TEST(ProgressEstimate, time_limit_ends_it) {
    const RemainingTime rest = estimate_remaining(
        {.samples = 25.0, .end = 100.0, .end_high = 100.0, .sampling_s = 50.0, .limit_left_s = 10.0});
    EXPECT_EQ(rest.high_s, 10.0);
    EXPECT_NEAR(rest.done, 50.0 / 60.0, 1e-9);
}

TEST(TimeRange, both_ends_have_one_unit) {
    EXPECT_EQ(time_range_text(4.13, 6.18), "4.1 to 6.2 s");
    EXPECT_EQ(time_range_text(12.2, 12.4), "12 s");
    EXPECT_EQ(time_range_text(240.0, 600.0), "4.0 to 10 min");
    EXPECT_EQ(time_range_text(50.0, 130.0), "0.8 to 2.2 min");
    EXPECT_EQ(time_range_text(80000.0, 99900.0), "22 to 28 h");
}

}  // namespace
}  // namespace voxilux
