#include "python/render_in_memory.h"

#include <utility>

#include "jobs/memory_forecast.h"
#include "jobs/report.h"
#include "parse_values.h"

namespace voxilux {
namespace {

void check_flags(const RenderCommand& command) {
    if (!command.pictures.files.empty() || !command.sheet.empty() || !command.report.json.empty())
        refuse("output, sheet and json: render returns what these files would hold");
    if (is_part(command) || command.resume || command.checkpoint_s)
        refuse("samples, shard, resume and checkpoint: they need files; use the command line");
    if (asks_for_frames(command.scene) || command.scene.cameras.size() > 1)
        refuse("render returns one picture: choose it with frame and camera");
}

}  // namespace

RenderedInMemory render_in_memory(const RenderCommand& command, const std::atomic<bool>& interrupted,
                                  const std::function<void(const Progress&)>& on_progress) {
    check_flags(command);
    RenderOptions options = render_options(command);
    options.writes_exr = options.plan.effects.wants_aov = true;
    options.writes_png = false;
    options.interrupted = &interrupted;
    StepTimes times;
    Scene scene = scene_to_render(command, &times);
    options.steps = times.steps();
    const FrameList frames = frames_to_render(command.scene, scene);
    request_frames(scene, frames, options.plan);
    RenderSession session(std::move(scene), options);
    RenderOutcome outcome = session.render(frames.first, options.time_limit_s, on_progress);
    if (outcome.denoised) add_denoised(*outcome.denoised, outcome.image);
    outcome.statistics.peak_rss_mib = static_cast<double>(resident_bytes().peak) / 0x1p20;
    for (const std::string& message : session.end())
        outcome.statistics.validation.push_back(message);
    nlohmann::ordered_json report = report_json(session.scene(), outcome);
    return {std::move(outcome.image), std::move(report)};
}

}  // namespace voxilux
