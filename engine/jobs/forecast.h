#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "jobs/error_pilot.h"

namespace voxilux {

// Fraction of forecasts whose interval should contain the measured time.
inline constexpr double kForecastConfidence = 0.8;
// Standard deviations of the estimate at the upper end of that interval.
inline constexpr double kHighDeviations = 1.6;

// What a render to an error target is expected to take.
struct Forecast {
    double error = 0.0;                // requested
    bool is_reachable = true;          // with the allowed samples
    std::string reason;                // why it is not reachable; else empty
    std::uint32_t samples = 0;         // that the render takes before it first estimates its error
    std::uint32_t samples_high = 0;    // that it may take in the end
    double claimed = 0.0;              // expected error estimate with `samples`
    double pilot_s = 0.0;              // loading and pilot, which count as part of the time
    double expected_s = 0.0;           // of the whole render, as the report's wall_s
    double low_s = 0.0, high_s = 0.0;  // the interval of expected_s
};

// What is known besides the pilot.
struct ForecastNeeds {
    std::uint32_t max_samples = kMaxSamples;  // the most that the render may take
    std::uint32_t samples_done = 0;           // held by a checkpoint
    double pilot_s = 0.0;                     // from the start to the end of the pilot
    double pilot_uncertainty = 0.0;  // of pilot_s, relative, where another process runs its own pilot
    double film_values = 1.0;        // sums of the whole film, divided by those of its error
    std::optional<double> time_limit_s;
};

// The forecast for an error; nothing when the pilot found no error.
[[nodiscard]] std::optional<Forecast> make_forecast(const ErrorPilot& pilot, double error,
                                                    const ForecastNeeds& needs);

// Samples that a render takes for an error before it first estimates it: a compromise between certainly
// enough and probably enough. Nothing when kMaxSamples are not enough.
[[nodiscard]] std::optional<std::uint32_t> planned_samples(const ErrorCurve& curve, double error);

// Seconds per sample: `constant` + `falling` i^(alpha-1) for sample i, the cost of a shrinking photon kernel.
struct TimeCurve {
    double alpha = 1.0;
    double constant = 0.0;
    double falling = 0.0;
    double deviation = 0.0;  // relative uncertainty of the mean over a whole render

    [[nodiscard]] double mean_of(double samples) const;
};

[[nodiscard]] TimeCurve fit_times(const ErrorLaw& law, const std::vector<SampleTime>& times);

// A film's sums divided by those that its error is estimated from.
[[nodiscard]] double film_values(const RenderPlan& plan);

}  // namespace voxilux
