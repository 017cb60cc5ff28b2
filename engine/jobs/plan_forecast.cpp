#include "jobs/plan_forecast.h"

#include <algorithm>
#include <array>
#include <utility>

#include "base/clock.h"
#include "jobs/effect_price.h"
#include "jobs/forecast_report.h"
#include "jobs/memory_forecast.h"
#include "jobs/report.h"

namespace voxilux {
namespace {

using Json = nlohmann::ordered_json;

// Other error targets to forecast, relative to the requested one: a finer and a coarser image.
constexpr std::array<double, 2> kOtherErrors{0.5, 2.0};
// Relative: files and pipelines may be cached in one process and not in the other.
constexpr double kPilotDoubt = 0.4;

std::string forecast_line(const Forecast& forecast) {
    const std::string error = percent_text(forecast.error);
    if (!forecast.is_reachable)
        return fmt::format("forecast  {:<8} out of reach: {}; {} of up to {} after {} samples, {}\n", error,
                           forecast.reason, "an error", percent_text(forecast.claimed), forecast.samples,
                           time_range_text(forecast.low_s, forecast.high_s));
    const std::string samples = forecast.samples == forecast.samples_high
                                    ? fmt::format("{}", forecast.samples)
                                    : fmt::format("{} to {}", forecast.samples, forecast.samples_high);
    return fmt::format("forecast  {:<8} {} samples, {}\n", error, samples,
                       time_range_text(forecast.low_s, forecast.high_s));
}

std::string mib_text(std::uint64_t bytes) {
    return fmt::format("{:.1f} MiB", static_cast<double>(bytes) / 0x1p20);
}

// The effects that would change the image if the user had not switched them off.
std::vector<Effect> forced_off(const RenderPlan& plan, const PlanRequest& request) {
    std::vector<Effect> effects;
    for (const auto& [effect, choice] : request.effects.switches)
        if (choice == Switch::off && plan.effects[static_cast<std::size_t>(effect)].by_choice)
            effects.push_back(effect);
    return effects;
}

void add_price(const EffectPrice& price, PilotedPlan& result) {
    const std::string name(name_of(price.effect));
    for (Json& row : result.json["effects"]) {
        if (row["name"] != name) continue;
        row["error_without"] = {{"estimate", price.error},
                                {"low", price.error_low},
                                {"high", price.error_high},
                                {"beyond_noise", price.is_beyond_noise}};
        row["ms_per_sample"] = price.ms_per_sample;
    }
    result.text += fmt::format(
        "without   {:<10} the image has an error of {} ({} to {}); with it a sample takes {:.1f} ms more\n",
        name, percent_text(price.error), percent_text(price.error_low), percent_text(price.error_high),
        price.ms_per_sample);
}

// What the user's choices cost in error, from a session of its own without an error target.
void price_forced_off(const Scene& scene, std::int64_t frame, const RenderOptions& options,
                      PilotedPlan& result) {
    const std::vector<Effect> effects = forced_off(result.plan, options.plan);
    if (effects.empty()) return;
    RenderOptions unlimited{.plan = options.plan, .device = options.device, .executor = options.executor};
    RenderSession session(scene, unlimited);
    const PriceJob job{
        .frame = frame, .settings = scene.settings, .request = options.plan, .effects = effects};
    for (const EffectPrice& price : price_effects(session, job))
        add_price(price, result);
}

}  // namespace

PilotedPlan pilot_plan(const Scene& animated, std::int64_t frame, const RenderOptions& options) {
    RenderSession session(animated, options);
    const bool is_denoised = options.plan.wants_denoised && session.plan_of(frame).is_denoised();
    const std::optional<ErrorPilot> pilot = is_denoised ? std::nullopt : session.pilot(frame);
    PilotedPlan result{.plan = session.plan(), .json = plan_json(session.scene(), session.plan())};
    if (!pilot) {
        result.text =
            fmt::format("forecast  unknown: {}\n",
                        is_denoised ? "how fast the error of a denoised picture falls depends on it"
                                    : "samples depend on earlier ones, so their error cannot be estimated");
        return result;
    }
    const double error = *options.error_target;
    ForecastNeeds needs{.max_samples = result.plan.samples(),
                        .pilot_s = seconds_since(options.started),
                        .pilot_uncertainty = kPilotDoubt,
                        .film_values = film_values(result.plan),
                        .time_limit_s = options.time_limit_s};
    const std::optional<Forecast> asked = make_forecast(*pilot, error, needs);
    result.json["forecast"] = forecast_json(asked);
    result.text =
        asked ? forecast_line(*asked) : "forecast  unknown: the image has no noise yet to estimate from\n";
    result.json["forecasts"] = Json::array({forecast_json(asked)});
    for (const double factor : kOtherErrors) {
        const std::optional<Forecast> other = make_forecast(*pilot, factor * error, needs);
        result.json["forecasts"].push_back(forecast_json(other));
        if (other) result.text += forecast_line(*other);
    }
    const MemoryForecast memory =
        forecast_memory(result.plan, picture_use(options, asked ? asked->high_s : 0.0));
    result.json["memory_total"] = {{"device_bytes", memory.device_bytes},
                                   {"peak_rss_mib", static_cast<double>(memory.peak_rss_bytes) / 0x1p20}};
    result.text += fmt::format("memory    {} on the device, {} of the process at most\n",
                               mib_text(memory.device_bytes), mib_text(memory.peak_rss_bytes));
    price_forced_off(animated, frame, options, result);
    return result;
}

}  // namespace voxilux
