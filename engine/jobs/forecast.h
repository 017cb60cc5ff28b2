#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "jobs/error_pilot.h"

namespace voxilux {

// Share of forecasts that are meant to hold the real time.
inline constexpr double kForecastConfidence = 0.8;
// Deviations of the claim at the upper end of that interval.
inline constexpr double kHighDeviations = 1.6;

// What a render to an error is expected to take.
struct Forecast {
    double error = 0.0;                // asked for
    bool is_reachable = true;          // with the samples allowed
    std::string reason;                // why it is not; else empty
    std::uint32_t samples = 0;         // that the render will take before it looks at its error
    std::uint32_t samples_high = 0;    // that it may take in the end
    double claimed = 0.0;              // error that it is expected to claim with `samples`
    double pilot_s = 0.0;              // loading and pilot, which are part of the time
    double expected_s = 0.0;           // of the whole render, as the report's wall_s
    double low_s = 0.0, high_s = 0.0;  // an interval of it
};

// What is known beside the pilot.
struct ForecastNeeds {
    std::uint32_t max_samples = kMaxSamples;  // that the render may take
    std::uint32_t samples_done = 0;           // that a checkpoint holds
    double pilot_s = 0.0;                     // from the start to the end of the pilot
    double pilot_uncertainty = 0.0;           // of pilot_s, relative, where another process will have its own
    double film_values = 1.0;                 // sums of the whole film over those of its error
    std::optional<double> time_limit_s;
};

// The forecast for an error; nothing when the pilot knows nothing.
[[nodiscard]] std::optional<Forecast> make_forecast(const ErrorPilot& pilot, double error,
                                                    const ForecastNeeds& needs);

// Samples that a render takes for an error before it looks: fewer than would be certain, more than are
// likely to be enough. Nothing when kMaxSamples are not.
[[nodiscard]] std::optional<std::uint32_t> planned_samples(const ErrorCurve& curve, double error);

// Seconds per sample: `constant` + `falling` i^(alpha-1) for sample i, which is what a shrinking disc costs.
struct TimeCurve {
    double alpha = 1.0;
    double constant = 0.0;
    double falling = 0.0;
    double deviation = 0.0;  // relative, of the mean over a whole render

    [[nodiscard]] double mean_of(double samples) const;
};

[[nodiscard]] TimeCurve fit_times(const ErrorLaw& law, const std::vector<SampleTime>& times);

// A film's sums over those that its error is estimated from.
[[nodiscard]] double film_values(const RenderPlan& plan);

}  // namespace voxilux
