#include "jobs/forecast_report.h"

#include <cmath>

#include <fmt/format.h>

namespace voxilux {
namespace {

using Json = nlohmann::ordered_json;

bool is_inside(const Forecast& forecast, double seconds) {
    return seconds >= forecast.low_s && seconds <= forecast.high_s;
}

struct Unit {
    double seconds = 1.0;
    const char* name = "s";
};

Unit unit_of(double seconds) {
    if (seconds < 100.0) return {1.0, "s"};
    if (seconds < 6000.0) return {60.0, "min"};
    if (seconds < 4.0 * 86400.0) return {3600.0, "h"};
    return {86400.0, "days"};
}

// Two significant digits, but all digits before the decimal point.
std::string two_digits(double value) {
    return value < 10.0 ? fmt::format("{:.1f}", value) : fmt::format("{:.0f}", value);
}

}  // namespace

Json forecast_json(const std::optional<Forecast>& forecast) {
    if (!forecast) return {{"low_s", nullptr}, {"high_s", nullptr}};
    Json json = {{"low_s", forecast->low_s},           {"high_s", forecast->high_s},
                 {"expected_s", forecast->expected_s}, {"confidence", kForecastConfidence},
                 {"error", forecast->error},           {"reachable", forecast->is_reachable}};
    json["reason"] = forecast->is_reachable ? Json(nullptr) : Json(forecast->reason);
    json["samples"] = forecast->samples;
    json["samples_high"] = forecast->samples_high;
    json["claimed"] = forecast->claimed;
    return json;
}

Json judged_forecast_json(const RenderStatistics& statistics) {
    Json json = forecast_json(statistics.forecast);
    if (!statistics.forecast) return json;
    json["outcome"] = {{"wall_s", statistics.wall_s}, {"samples", statistics.samples}};
    const double high = statistics.error.high;
    json["outcome"]["error_high"] = std::isfinite(high) ? Json(high) : Json(nullptr);
    json["outcome"]["inside"] = is_inside(*statistics.forecast, statistics.wall_s);
    return json;
}

std::string time_range_text(double low_s, double high_s) {
    if (!std::isfinite(high_s)) return "?";
    const Unit unit = unit_of(high_s);
    const std::string low = two_digits(low_s / unit.seconds), high = two_digits(high_s / unit.seconds);
    if (low == high) return fmt::format("{} {}", high, unit.name);
    return fmt::format("{} to {} {}", low, high, unit.name);
}

std::string percent_text(double share) {
    return fmt::format("{:.3g} %", 100.0 * share);
}

std::string judged_forecast_text(const RenderStatistics& statistics) {
    if (!statistics.forecast) return {};
    const Forecast& forecast = *statistics.forecast;
    return fmt::format("forecast  {}, {} samples; it was {:.2f} s, {}\n",
                       time_range_text(forecast.low_s, forecast.high_s), forecast.samples, statistics.wall_s,
                       is_inside(forecast, statistics.wall_s) ? "inside" : "outside");
}

}  // namespace voxilux
