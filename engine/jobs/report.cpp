#include "jobs/report.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "frame/footprint.h"
#include "jobs/effect_time.h"
#include "jobs/forecast_report.h"
#include "jobs/occlusion_report.h"
#include "jobs/photon_report.h"
#include "scene/scene_hash.h"

namespace voxilux {
namespace {

using Json = nlohmann::ordered_json;

Json effects_json(const RenderPlan& plan, const RenderStatistics* statistics) {
    Json rows = Json::array();
    for (const EffectState& state : plan.effects) {
        const std::string name(name_of(state.effect));
        Json row = {{"name", name}, {"on", state.on}, {"reason", state.reason}};
        if (statistics != nullptr) {
            row["ms"] = effect_ms(plan, statistics->passes, state.effect);
        }
        rows.push_back(row);
    }
    return rows;
}

Json techniques_json(const RenderPlan& plan) {
    Json rows = Json::array();
    for (const auto& [technique, reason] : plan.techniques) {
        rows.push_back({{"effect", name_of(technique->effect)},
                        {"technique", technique->name},
                        {"reason", reason},
                        {"what", technique->sentence},
                        {"biased", technique->biased},
                        {"independent_samples", technique->independent_samples},
                        {"whole_frame", technique->whole_frame},
                        {"keeps_state", technique->keeps_state()},
                        {"mergeable", technique->mergeable()},
                        {"needs_pilot", technique->needs_pilot}});
    }
    return rows;
}

Json head_json(const Scene& scene, const RenderPlan& plan, const char* command) {
    const glm::ivec2 first = plan.first_pixel;
    const glm::ivec2 size = plan.settings.size;
    Json json = {{"version", VX_VERSION},
                 {"command", command},
                 {"scene_hash", fmt::format("{:016x}", sample_hash(scene))},
                 {"seed", plan.settings.seed},
                 {"size", {plan.image_size.x, plan.image_size.y}}};
    if (plan.image_size != size) json["crop"] = {first.x, first.y, first.x + size.x, first.y + size.y};
    if (!plan.part.is_leading()) json["sample_ranges"] = plan.part.text();
    return json;
}

std::string_view name_of(StopReason reason) {
    switch (reason) {
        case StopReason::finished:
            return "finished";
        case StopReason::error_target:
            return "error target reached";
        case StopReason::time_limit:
            return "time limit reached";
        case StopReason::interrupted:
            return "interrupted";
    }
    VX_ASSERT(false);
}

Json planned_passes_json(const Footprint& needs) {
    Json rows = Json::array();
    for (const PlannedPass& pass : needs.passes)
        rows.push_back({{"label", pass.label}, {"count", pass.count}});
    return rows;
}

Json planned_memory_json(const Footprint& needs) {
    Json rows = Json::array();
    for (const PlannedBuffer& planned : needs.buffers)
        rows.push_back({{"buffer", planned.buffer}, {"bytes", planned.bytes}});
    return rows;
}

Json passes_json(const std::vector<PassTime>& passes) {
    Json rows = Json::array();
    for (const PassTime& pass : passes)
        rows.push_back(
            {{"label", pass.label}, {"count", pass.count}, {"ms", pass.ms}, {"max_ms", pass.max_ms}});
    return rows;
}

void add_statistics(RenderStatistics& total, const RenderStatistics& frame) {
    total.wall_s += frame.wall_s;
    total.cpu_s = frame.cpu_s;  // of the process so far
    total.peak_rss_mib = frame.peak_rss_mib;
    total.load_s += frame.load_s;
    add_step_times(total.steps, frame.steps);
    total.gpu_ms += frame.gpu_ms;
    add_times(total.passes, frame.passes);
    for (const auto& [name, count] : frame.work)
        total.work[name] += count;
    for (const auto& [name, count] : frame.faults)
        total.faults[name] += count;
    total.memory = frame.memory;
    total.pipelines = frame.pipelines;
    total.samples = std::min(total.samples, frame.samples);
    total.live_cells = frame.live_cells;
    if (!(frame.error.high <= total.error.high)) total.error = frame.error;
    total.rounds = std::max(total.rounds, frame.rounds);
    total.decided_by = std::max(total.decided_by, frame.decided_by);
    total.forecast.reset();  // of the first frame alone
    total.next_minute.reset();
    total.stop = std::max(total.stop, frame.stop);  // the reasons are in order of precedence
    for (const std::string& warning : frame.warnings) {
        if (std::ranges::find(total.warnings, warning) == total.warnings.end())
            total.warnings.push_back(warning);
    }
    total.validation.insert(total.validation.end(), frame.validation.begin(), frame.validation.end());
}

// Null where there are no voxels to march through.
Json traversal_json(const RenderPlan& plan) {
    if (!plan.has(Effect::voxels)) return nullptr;
    return {{"name", name_of(plan.world.traversal)}, {"reason", plan.world.traversal_reason}};
}

// What depends on the order of threads: where keys with the same home slot lie in the table, and how many
// compete for one slot.
constexpr std::array<const char*, 2> kUnrepeatableWork{"ao_probes", "ao_swaps"};

}  // namespace

std::string error_text(const ErrorEstimate& error) {
    return fmt::format("{:.3g} ({}, {:.0f} % confidence: {:.3g} to {:.3g})", error.estimate, error.metric,
                       100.0 * error.confidence, error.low, error.high);
}

Json error_json(const ErrorEstimate& error) {
    if (!error.is_known())
        return {{"metric", error.metric},
                {"estimate", nullptr},
                {"low", nullptr},
                {"high", nullptr},
                {"confidence", nullptr}};
    Json json = {{"metric", error.metric}, {"estimate", error.estimate}, {"low", error.low}};
    json["high"] = std::isfinite(error.high) ? Json(error.high) : Json(nullptr);
    json["confidence"] = error.confidence;
    if (error.noise) json["noise"] = *error.noise;
    if (error.bias) json["bias"] = *error.bias;
    return json;
}

Json report_json(const Scene& scene, const RenderOutcome& outcome) {
    const RenderStatistics& statistics = outcome.statistics;
    Json json = head_json(scene, outcome.plan, "render");
    json["device"] = {{"name", statistics.device.name},
                      {"driver", statistics.device.driver},
                      {"type", statistics.device.type}};
    json["traversal"] = traversal_json(outcome.plan);
    json["occlusion"] = occlusion_json(outcome.plan, statistics);
    json["photons"] = photons_json(outcome.plan);
    json["samples"] = statistics.samples;
    json["stopped"] = name_of(statistics.stop);
    json["wall_s"] = statistics.wall_s;
    json["cpu_s"] = statistics.cpu_s;
    json["load_s"] = statistics.load_s;
    json["steps"] = steps_json(statistics.steps);
    json["first_pixel_s"] = statistics.first_pixel_s;
    json["peak_rss_mib"] = statistics.peak_rss_mib;
    json["gpu_ms"] = statistics.gpu_ms;
    json["passes"] = passes_json(statistics.passes);
    json["work"] = statistics.work;
    json["memory"] = Json::array();
    for (const MemoryRow& row : statistics.memory)
        json["memory"].push_back({{"buffer", row.buffer}, {"bytes", row.bytes}});
    json["effects"] = effects_json(outcome.plan, &statistics);
    json["error"] = error_json(statistics.error);
    json["error"]["rounds"] = statistics.rounds;
    json["error"]["decided_by"] = name_of(statistics.decided_by);
    if (outcome.denoised) json["denoised"] = denoised_json(*outcome.denoised);
    json["forecast"] = judged_forecast_json(statistics);
    json["next_minute"] = next_minute_json(statistics.next_minute);
    json["faults"] = statistics.faults;
    json["without"] = outcome.plan.without;
    json["notes"] = outcome.plan.notes;
    json["warnings"] = statistics.warnings;
    return json;
}

Json steps_json(const std::vector<StepTime>& steps) {
    Json rows = Json::array();
    for (const StepTime& step : steps)
        rows.push_back({{"label", step.label}, {"wall_s", step.time.wall}, {"cpu_s", step.time.cpu}});
    return rows;
}

Json denoised_json(const Denoised& denoised) {
    Json json{{"filtered", denoised.is_filtered()}};
    json["reason"] = denoised.is_filtered() ? Json(nullptr) : Json(denoised.reason);
    json["error"] = error_json(denoised.claim);
    return json;
}

std::string denoised_text(const Denoised& denoised) {
    if (!denoised.is_filtered()) return fmt::format("denoised  no: {}\n", denoised.reason);
    return fmt::format("denoised  {}\n", error_text(denoised.claim));
}

void add_frame(SequenceReport& report, std::int64_t frame, const std::vector<std::string>& files,
               const RenderOutcome& outcome) {
    const RenderStatistics& statistics = outcome.statistics;
    if (report.frames.empty()) {
        report.total.plan = outcome.plan;
        report.total.statistics = statistics;
    } else {
        add_statistics(report.total.statistics, statistics);
    }
    report.frames.push_back({{"frame", frame},
                             {"files", files},
                             {"samples", statistics.samples},
                             {"stopped", name_of(statistics.stop)},
                             {"wall_s", statistics.wall_s},
                             {"gpu_ms", statistics.gpu_ms},
                             {"passes", passes_json(statistics.passes)},
                             {"work", statistics.work},
                             {"error", error_json(statistics.error)},
                             {"faults", statistics.faults}});
    if (outcome.denoised) report.frames.back()["denoised"] = denoised_json(*outcome.denoised);
}

Json sequence_json(const Scene& scene, std::uint64_t scene_hash, const SequenceReport& report) {
    Json json = report_json(scene, report.total);
    json["scene_hash"] = fmt::format("{:016x}", scene_hash);
    json["frames"] = report.frames;
    return json;
}

Json reproducible_report_json(const Scene& scene, const RenderOutcome& outcome) {
    return reproducible_report(report_json(scene, outcome));
}

Json reproducible_report(const Json& report) {
    Json json;
    for (const char* key : {"version", "command", "scene_hash", "seed", "size", "crop", "sample_ranges",
                            "samples", "work", "effects", "error", "denoised", "faults"}) {
        if (report.contains(key)) json[key] = report.at(key);
    }
    for (const char* name : kUnrepeatableWork)
        json["work"].erase(name);
    for (const char* name : {"rounds", "decided_by"})  // differ when samples were taken in parts
        json["error"].erase(name);
    for (Json& effect : json["effects"])
        effect.erase("ms");
    return json;
}

Json plan_json(const Scene& scene, const RenderPlan& plan) {
    Json json = head_json(scene, plan, "plan");
    json["traversal"] = traversal_json(plan);
    json["occlusion"] = planned_occlusion_json(plan);
    json["photons"] = photons_json(plan);
    json["effects"] = effects_json(plan, nullptr);
    json["techniques"] = techniques_json(plan);
    const Footprint needs = footprint(plan);
    json["passes"] = planned_passes_json(needs);
    json["memory"] = planned_memory_json(needs);
    json["rays"] = {{"primary", plan.rays.primary}, {"ao", plan.rays.ao}, {"sun", plan.rays.sun}};
    json["forecast"] = forecast_json(std::nullopt);  // without an error target there is no pilot
    json["without"] = plan.without;
    json["notes"] = plan.notes;
    return json;
}

std::string describe(const RenderOutcome& outcome) {
    const RenderStatistics& s = outcome.statistics;
    std::string text = fmt::format("device    {} ({})\n", s.device.name, s.device.driver);
    text +=
        fmt::format("samples   {} of {} per pixel, {}\n", s.samples, outcome.plan.samples(), name_of(s.stop));
    if (!outcome.plan.part.empty()) text += fmt::format("part      samples {}\n", outcome.plan.part.text());
    text += fmt::format("time      {:.2f} s wall, {:.2f} s CPU; first pixels after {:.2f} s\n", s.wall_s,
                        s.cpu_s, s.first_pixel_s);
    for (const PassTime& pass : s.passes)
        text += fmt::format("pass      {:<14} {:>6} x {:>10.1f} ms\n", pass.label, pass.count, pass.ms);
    text += occlusion_text(outcome.plan, s);
    if (outcome.plan.photons.runs())
        text += fmt::format("photons   {} per iteration, first radius {:.3g}\n", outcome.plan.photons.count(),
                            outcome.plan.photons.radius);
    text += fmt::format("error     {}\n",
                        s.error.is_known() ? error_text(s.error) : "unknown: pixels share occlusion samples");
    if (outcome.denoised) text += denoised_text(*outcome.denoised);
    for (const std::string& effect : outcome.plan.without)
        text += fmt::format("without   {}\n", effect);
    text += judged_forecast_text(s);
    if (const std::string minute = next_minute_text(s.next_minute); !minute.empty())
        text += fmt::format("next      {}\n", minute);
    for (const auto& [name, count] : s.faults) {
        if (count != 0) text += fmt::format("fault     {} {}\n", name, count);
    }
    return text;
}

}  // namespace voxilux
