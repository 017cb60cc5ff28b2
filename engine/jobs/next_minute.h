#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "estimators/error_curve.h"
#include "plan/effects.h"

namespace voxilux {

// How much of the noise one effect causes.
struct NoiseShare {
    Effect effect = Effect::ao;
    std::optional<double> share;  // of the squared noise; nothing where unknown
    std::string reason;           // why it is unknown
};

// What one more minute would have improved in a render.
struct NextMinute {
    double seconds_per_sample = 0.0;
    double samples = 0.0;                      // taken in that minute
    double error_now = 0.0, error_then = 0.0;  // expected, sqrt(relMSE)
    std::optional<double> bias_now, bias_then;
    std::vector<NoiseShare> shares;
};

inline constexpr double kMinute_s = 60.0;

// `samples` and the time per sample are those at the end of the render.
[[nodiscard]] NextMinute price_next_minute(const ErrorCurve& curve, double samples, double seconds_per_sample,
                                           std::vector<NoiseShare> shares);

// {seconds, samples, error: {now, then, change}, bias, effects: [{name, noise_share, change, reason}]}; null
// when nothing is known.
[[nodiscard]] nlohmann::ordered_json next_minute_json(const std::optional<NextMinute>& minute);

// One line for people, without an end of line; empty when nothing is known.
[[nodiscard]] std::string next_minute_text(const std::optional<NextMinute>& minute);

}  // namespace voxilux
