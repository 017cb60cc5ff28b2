#include "jobs/forecast.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.h"
#include "plan/film_planes.h"

namespace voxilux {
namespace {

// Standard deviations of the estimate by which a render exceeds the expected samples before it estimates its
// error. A second round costs little but is decided by the samples that it averages.
constexpr double kPlanDeviations = 0.75;
constexpr std::uint32_t kMinSamples = 8;
constexpr std::uint32_t kWholeSamples = 4;  // rounds up to a multiple: halves of equal size
// Relative: slow changes of the machine's speed, which no pilot sees.
constexpr double kMinDrift = 0.08;
constexpr double kDriftDeviations = 2.0;
constexpr std::size_t kTimeGroups = 4;
// Cost of a render's end in readings of the error film: reading, image and estimate of all planes.
constexpr double kEndReadings = 1.5;
constexpr double kRoundReadings = 1.0;

// Uncertainty of the mean over a render, from how groups of successive samples differ.
double drift_of(const std::vector<SampleTime>& times, const TimeCurve& curve) {
    if (times.size() < 2 * kTimeGroups) return 2.0 * kMinDrift;
    std::array<double, kTimeGroups> means{};
    for (std::size_t group = 0; group < kTimeGroups; ++group) {
        const std::size_t first = group * times.size() / kTimeGroups;
        const std::size_t end = (group + 1) * times.size() / kTimeGroups;
        for (std::size_t i = first; i < end; ++i) {
            const double expected =
                curve.constant + curve.falling * std::pow(times[i].number, curve.alpha - 1.0);
            means[group] += times[i].seconds / expected / static_cast<double>(end - first);
        }
    }
    double square = 0.0;
    for (const double mean : means)
        square += (mean - 1.0) * (mean - 1.0) / static_cast<double>(kTimeGroups - 1);
    return std::max(kMinDrift, kDriftDeviations * std::sqrt(square));
}

std::uint32_t rounded_samples(std::uint32_t samples, std::uint32_t most) {
    const std::uint32_t whole = (samples + kWholeSamples - 1) / kWholeSamples * kWholeSamples;
    return std::min(std::max(whole, kMinSamples), most);
}

std::string reason_of(const ErrorCurve& curve, const Forecast& forecast, std::uint32_t most) {
    const double at_most = claimed_error(curve, kMaxSamples);
    if (at_most > forecast.error && curve.law.alpha == 1.0 && curve.law.has_bias)
        return "the blur of a radius that does not shrink stays";
    if (at_most > forecast.error)
        return fmt::format("{} samples, the most that a film holds, are not enough", kMaxSamples);
    return fmt::format("it needs more than the {} samples allowed", most);
}

}  // namespace

double TimeCurve::mean_of(double samples) const {
    return constant + falling * mean_power(std::max(samples, 1.0), alpha - 1.0);
}

// Least squares with both terms at least 0.
TimeCurve fit_times(const ErrorLaw& law, const std::vector<SampleTime>& times) {
    TimeCurve curve{.alpha = law.alpha};
    if (times.empty()) return curve;
    double count = 0.0, x = 0.0, xx = 0.0, y = 0.0, xy = 0.0;
    for (const SampleTime& time : times) {
        const double at = std::pow(time.number, law.alpha - 1.0);
        count += 1.0;
        x += at;
        xx += at * at;
        y += time.seconds;
        xy += at * time.seconds;
    }
    const double scatter = count * xx - x * x;
    if (law.alpha < 1.0 && scatter > 0.0) curve.falling = std::max((count * xy - x * y) / scatter, 0.0);
    curve.constant = (y - curve.falling * x) / count;
    if (curve.constant < 0.0) {
        curve.constant = 0.0;
        curve.falling = xy / xx;
    }
    curve.deviation = drift_of(times, curve);
    return curve;
}

double film_values(const RenderPlan& plan) {
    double all = 0.0;
    double of_error = 2.0 * 3.0;  // beauty_a and beauty_b
    for (const FilmPlane& plane : film_planes(plan))
        all += plane.components;
    if (plan.sums_squares) of_error += 3.0;
    if (plan.sums_bias) of_error += 2.0 * 3.0;
    return all / of_error;
}

std::optional<std::uint32_t> planned_samples(const ErrorCurve& curve, double error) {
    const auto samples = samples_for(curve, error, kPlanDeviations);
    if (!samples) return std::nullopt;
    return rounded_samples(*samples, kMaxSamples);
}

std::optional<Forecast> make_forecast(const ErrorPilot& pilot, double error, const ForecastNeeds& needs) {
    const auto curve = fit_error(pilot.law, pilot.points);
    if (!curve || pilot.times.empty()) return std::nullopt;
    const std::uint32_t most = needs.max_samples;
    const auto planned = planned_samples(*curve, error);
    Forecast forecast{.error = error, .is_reachable = planned && *planned <= most, .pilot_s = needs.pilot_s};
    forecast.samples = forecast.is_reachable ? *planned : most;
    const std::uint32_t high = samples_for(*curve, error, kHighDeviations).value_or(most);
    forecast.samples_high = std::max(forecast.samples, rounded_samples(high, most));
    forecast.claimed = claimed_error(*curve, forecast.samples);
    if (!forecast.is_reachable) forecast.reason = reason_of(*curve, forecast, most);

    const TimeCurve times = fit_times(pilot.law, pilot.times);
    const auto seconds_to = [&](std::uint32_t samples) {
        const double left = samples - std::min(samples, needs.samples_done);
        return left * times.mean_of(samples);
    };
    const double expected = seconds_to(forecast.samples), max_s = seconds_to(forecast.samples_high);
    const double end_s = pilot.film_s * (kRoundReadings + kEndReadings * needs.film_values);
    forecast.expected_s = needs.pilot_s + expected + end_s;
    forecast.low_s =
        needs.pilot_s * (1.0 - needs.pilot_uncertainty) + expected / (1.0 + times.deviation) + 0.5 * end_s;
    forecast.high_s =
        needs.pilot_s * (1.0 + needs.pilot_uncertainty) + max_s * (1.0 + times.deviation) + 2.0 * end_s;
    if (!needs.time_limit_s) return forecast;
    for (double* seconds : {&forecast.expected_s, &forecast.low_s, &forecast.high_s})
        *seconds = std::min(*seconds, *needs.time_limit_s);
    return forecast;
}

}  // namespace voxilux
