#include "jobs/price_list/price_list.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <thread>

#include <fmt/format.h>

#include "base/median.h"
#include "frame/footprint.h"
#include "jobs/or_null.h"
#include "jobs/price_list/difference_map.h"
#include "jobs/report.h"

namespace voxilux {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kKibPerGib = 1024.0 * 1024.0;

Json to_json(const std::optional<Slope>& slope, const char* of) {
    if (!slope) return nullptr;
    return {{"value", slope->value}, {"low", slope->low}, {"high", slope->high}, {"of", of}};
}

Json times_json(const std::vector<double>& times) {
    return {{"median", median(times)}, {"low", std::ranges::min(times)}, {"high", std::ranges::max(times)}};
}

Json to_json(const SplitError& error) {
    return {{"total", error.total},       {"noise", error.noise},         {"bias", error.bias},
            {"bias_low", error.bias_low}, {"bias_high", error.bias_high}, {"is_limited", error.is_limited}};
}

Json claimed_json(const ErrorEstimate& claimed) {
    if (!claimed.is_known() || !std::isfinite(claimed.estimate)) return nullptr;
    return {{"estimate", claimed.estimate}, {"low", claimed.low}, {"high", finite_or_null(claimed.high)}};
}

Json curve_json(const MeasuredConfiguration& configuration) {
    Json curve = Json::array();
    for (const Level& level : configuration.levels)
        curve.push_back({{"samples", level.samples},
                         {"time_s", times_json(level.times_s)},
                         {"error", to_json(level.error)},
                         {"claimed", claimed_json(level.claimed)}});
    return curve;
}

Json run_json(const PriceList& list, const PricedRun& run) {
    const MeasuredConfiguration& configuration = list.configurations[run.configuration];
    const Level& level = level_of(list, run);
    const bool has_picture = !level.picture.channels.empty();
    const std::string picture = picture_of_run(run);
    Json json = {{"id", run.id},
                 {"knob", list.design.parameters[run.parameter].name},
                 {"setting", run.setting},
                 {"is_default", run.is_default},
                 {"settings", settings_json(configuration.configuration, configuration.plan, level.samples)},
                 {"time_s", times_json(level.times_s)},
                 {"load_s", configuration.load_s},
                 {"memory_bytes", footprint(configuration.plan).total_bytes()},
                 {"error", to_json(level.error)},
                 {"claimed", claimed_json(level.claimed)},
                 {"picture", has_picture ? Json(picture) : Json(nullptr)},
                 {"difference", has_picture ? Json(difference_of(picture)) : Json(nullptr)}};
    json["differing_pixels"] = or_null(configuration.other_pixels);
    if (list.design.parameters[run.parameter].name == "samples") return json;
    json["slope"] = to_json(slope_of(configuration), "error against time");
    json["slope_of_samples"] = to_json(slope_of_samples(configuration), "error against samples");
    json["curve"] = curve_json(configuration);
    return json;
}

Json parameter_json(const PriceList& list, const std::vector<PricedRun>& runs, std::size_t index) {
    const Parameter& parameter = list.design.parameters[index];
    Json json = {{"name", parameter.name},
                 {"label", parameter.label},
                 {"axis", parameter.axis},
                 {"why", parameter.why}};
    json["runs"] = Json::array();
    for (const PricedRun& run : runs)
        if (run.parameter == index) json["runs"].push_back(run.id);
    const bool is_samples = parameter.name == "samples";
    json["slope"] =
        is_samples ? to_json(slope_of(list.configurations.front()), "error against time") : Json(nullptr);
    if (is_samples)
        json["slope_of_samples"] =
            to_json(slope_of_samples(list.configurations.front()), "error against samples");
    json["left_out"] = Json::array();
    for (const ParameterSetting& setting : parameter.settings) {
        const std::string& refusal = list.configurations[setting.configuration].refusal;
        if (!refusal.empty()) json["left_out"].push_back({{"setting", setting.name}, {"why", refusal}});
    }
    return json;
}

Json effects_json(const PriceList& list) {
    Json rows = Json::array();
    for (const EffectState& state : list.configurations.front().plan.effects) {
        const auto priced = std::ranges::find(list.effects, state.effect, &EffectPrice::effect);
        Json row = {{"name", name_of(state.effect)}, {"on", state.on}, {"reason", state.reason}};
        row["forced"] = !state.on && priced != list.effects.end();
        row["by_choice"] = state.by_choice;
        if (priced == list.effects.end()) {
            for (const char* key : {"ms_per_sample", "ms_low", "ms_high", "error", "error_low", "error_high",
                                    "is_beyond_noise"})
                row[key] = nullptr;
        } else {
            row.update({{"ms_per_sample", priced->ms_per_sample},
                        {"ms_low", priced->ms_low},
                        {"ms_high", priced->ms_high},
                        {"error", priced->error},
                        {"error_low", priced->error_low},
                        {"error_high", priced->error_high},
                        {"is_beyond_noise", priced->is_beyond_noise}});
        }
        rows.push_back(row);
    }
    return rows;
}

Json row_json(const PriceList& list, const std::vector<PricedRun>& runs, const EqualRow& row,
              const char* name) {
    Json rows = Json::array();
    for (const EqualPicture& picture : row.pictures) {
        const bool is_first = &picture == &row.pictures.front();
        const PricedRun& run = run_of(list, runs, picture, is_first);
        const std::string file = file_of_row(name, run.id);
        const std::string label =
            is_first ? "default" : list.design.parameters[run.parameter].label + " " + run.setting;
        rows.push_back({{"id", run.id},
                        {"label", fmt::format("{}, {} samples", label, picture.samples)},
                        {"samples", picture.samples},
                        {"time_s", picture.time_s},
                        {"error", picture.error},
                        {"is_reached", picture.is_reached},
                        {"picture", file},
                        {"difference", difference_of(file)}});
    }
    return rows;
}

std::string value_after(const char* file, const std::string& name) {
    std::ifstream lines(file);
    for (std::string line; std::getline(lines, line);) {
        if (!line.starts_with(name)) continue;
        const std::size_t start = line.find_first_not_of(" \t", line.find(':') + 1);
        return start == std::string::npos ? "" : line.substr(start);
    }
    return "";
}

Json machine_json() {
    const std::string cpu = value_after("/proc/cpuinfo", "model name");
    const double memory_kib = std::strtod(value_after("/proc/meminfo", "MemTotal").c_str(), nullptr);
    return {{"cpu", cpu.empty() ? "unknown" : cpu},
            {"threads", std::thread::hardware_concurrency()},
            {"memory_gib", std::round(10.0 * memory_kib / kKibPerGib) / 10.0}};
}

Json reference_json(const Reference& reference) {
    return {{"picture", "pictures/reference.png"},   {"samples", reference.samples},
            {"settings", reference.settings},        {"time_s", reference.time_s},
            {"cached", reference.is_cached},         {"noise", std::sqrt(reference.noise().square)},
            {"bias", or_null(reference.error.bias)}, {"error", error_json(reference.error)}};
}

// Five stops of the scale of difference maps, evenly spaced in logarithms.
Json difference_colours_json() {
    Json stops = Json::array();
    for (int i = -4; i <= 0; ++i) {
        const double value = std::pow(10.0, 0.75 * i);
        const std::array<int, 3> rgb = difference_colour(value);
        stops.push_back(
            {{"value", value}, {"colour", fmt::format("#{:02x}{:02x}{:02x}", rgb[0], rgb[1], rgb[2])}});
    }
    return stops;
}

}  // namespace

Json to_json(const PriceList& list) {
    const std::vector<PricedRun> runs = list_runs(list);
    const glm::ivec2 size = list.configurations.front().plan.settings.size;
    Json json = {
        {"version", VX_VERSION},
        {"command", "tradeoff"},
        {"scene", list.scene},
        {"scene_hash", fmt::format("{:016x}", list.scene_hash)},
        {"seed", list.seed},
        {"size", {size.x, size.y}},
        {"machine", machine_json()},
        {"device", {{"name", list.device.name}, {"driver", list.device.driver}, {"type", list.device.type}}},
        {"repeats", list.repeats},
        {"wall_s", list.wall_s},
        {"asked_samples", list.asked},
        {"compared_samples", list.top},
        {"reference", reference_json(list.reference)}};
    for (const char* key : {"runs", "knobs", "front", "fixed"})
        json[key] = Json::array();
    for (const PricedRun& run : runs)
        json["runs"].push_back(run_json(list, run));
    for (std::size_t parameter = 0; parameter < list.design.parameters.size(); ++parameter)
        json["knobs"].push_back(parameter_json(list, runs, parameter));
    for (const PricedRun& run : front_of(list, runs))
        json["front"].push_back(run.id);
    json["effects"] = effects_json(list);
    json["equal_time"] = {{"time_s", list.equal_time.target},
                          {"runs", row_json(list, runs, list.equal_time, "equal-time")}};
    json["equal_error"] = {{"error", list.equal_error.target},
                           {"runs", row_json(list, runs, list.equal_error, "equal-error")}};
    for (const FixedChoice& fixed : list.design.fixed)
        json["fixed"].push_back({{"name", fixed.name}, {"value", fixed.value}, {"why", fixed.why}});
    json["difference_scale"] = kDifferenceScale;
    json["difference_colours"] = difference_colours_json();
    return json;
}

}  // namespace voxilux
