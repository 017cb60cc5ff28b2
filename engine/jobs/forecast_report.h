#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "jobs/forecast.h"
#include "jobs/render_session.h"

namespace voxilux {

// {low_s, high_s, expected_s, confidence, error, reachable, reason, samples, samples_high, claimed}; without
// a forecast only low_s and high_s, both null.
[[nodiscard]] nlohmann::ordered_json forecast_json(const std::optional<Forecast>& forecast);

// The same, with the `outcome`: {wall_s, samples, error_high, is_inside}.
[[nodiscard]] nlohmann::ordered_json judged_forecast_json(const RenderStatistics& statistics);

// "4.1 to 6.2 s", "4 to 6 min", "12 s": two times in the unit of the longer one. "?" for an invalid time.
[[nodiscard]] std::string time_range_text(double low_s, double high_s);

// "1 %", "0.25 %".
[[nodiscard]] std::string percent_text(double share);

// One line for people about a forecast and its outcome, with its end of line; empty without a forecast.
[[nodiscard]] std::string judged_forecast_text(const RenderStatistics& statistics);

}  // namespace voxilux
