#include "render/render.h"

#include <csignal>
#include <filesystem>
#include <utility>

#include "base/error.h"
#include "scene/scene_hash.h"
#include "jobs/memory_forecast.h"
#include "jobs/report.h"
#include "output_files.h"
#include "parse_values.h"
#include "render/progress_line.h"
#include "render/render_frames.h"
#include "render/render_output.h"
#include "render/render_part.h"

namespace voxilux {
namespace {

namespace fs = std::filesystem;

std::atomic<bool> interrupted = false;
static_assert(std::atomic<bool>::is_always_lock_free);

// The first signal asks for an end with a whole picture, the second one ends the process.
void on_interrupt(int signal) {
    interrupted = true;
    std::signal(signal, SIG_DFL);
}

// A picture that nobody named must not replace one that somebody kept.
void check_outputs(const RenderCommand& command, const std::vector<std::string>& outputs) {
    const FrameList frames = command.scene.frames ? parse_frames(*command.scene.frames) : FrameList{};
    for (std::int64_t i = 0; i < frames.count(); ++i) {
        for (const std::string& file : files_of_frame(outputs, frames, frames.at(i))) {
            if (command.outputs.empty() && fs::exists(file)) {
                throw Error(
                    ExitCode::usage,
                    fmt::format("render: no -o was given and {} is there already; -o {} overwrites it", file,
                                outputs.front()));
            }
            check_writable(file);
        }
    }
    check_writable(command.json);
}

int render_picture(const RenderCommand& command, RenderSession& session, const RenderJob& job) {
    RenderOutcome outcome =
        session.render(job.frames.first, job.options.time_limit_s, job.progress.callback());
    job.progress.finish();
    if (outcome.statistics.stop == StopReason::interrupted && outcome.statistics.first_pixel_s == 0.0)
        throw Error(ExitCode::interrupted, "interrupted before the first pixels; nothing was written");
    leave_checkpoint(command, job.outputs, session.scene(), outcome);
    write_pictures(command, job.outputs, session.scene(), outcome);
    remove_checkpoint(command, job.outputs, outcome);
    outcome.statistics.peak_rss_mib = static_cast<double>(resident_bytes().peak) / 0x1p20;
    for (const std::string& message : session.end())
        outcome.statistics.validation.push_back(message);
    print_validation(outcome);
    print_faults(outcome);
    std::set<std::string> said;
    print_warnings(command, outcome, said);
    print_missed_error(command, outcome);
    print_outcome(command, job.outputs, outcome);
    const nlohmann::ordered_json report = report_json(session.scene(), outcome);
    write_json(command.json, report);
    remember_forecast(command, report);
    return static_cast<int>(exit_code(command, outcome));
}

}  // namespace

CLI::App* add_render(CLI::App& app, RenderCommand& command) {
    CLI::App* render = app.add_subcommand("render", "render a scene to EXR and PNG");
    add_render_flags(*render, command);
    return render;
}

RenderOptions render_options(const RenderCommand& command, const std::vector<std::string>& outputs) {
    RenderOptions options;
    options.plan = request_of(command, outputs);
    options.device = command.device.request();
    options.executor.cache_dir = command.device.cache_dir();
    const glm::ivec2 group = parse_size("--group-size", command.group_size);
    options.executor.group_size = {static_cast<std::uint32_t>(group.x), static_cast<std::uint32_t>(group.y)};
    if (command.time_limit) options.time_limit_s = parse_duration(*command.time_limit);
    if (command.error) options.error_target = parse_error_target(*command.error);
    options.interrupted = &interrupted;
    set_part_options(command, outputs, options);
    options.rehearse_end = [&](const Scene& scene, RenderOutcome strip) {
        strip.statistics.stop = StopReason::time_limit;
        rehearse_output(command, outputs, scene, std::move(strip));
    };
    return options;
}

int run_render(const RenderCommand& command) {
    const std::vector<std::string> outputs = output_files(command);
    check_part_flags(command, outputs);
    RenderOptions options = render_options(command, outputs);
    ProgressLine progress(command.progress, command.quiet);
    (void)tone_options(command.tone, command.exposure_ev);
    check_outputs(command, outputs);
    std::signal(SIGINT, on_interrupt);
    std::signal(SIGTERM, on_interrupt);
    Scene scene = scene_to_render(command);
    const FrameList frames = frames_to_render(command.scene, scene);
    if (!command.quiet) print_frame_note(command.scene, scene);
    const std::uint64_t hash = frames.is_sequence ? scene_hash(scene) : 0;
    request_frames(scene, frames, options.plan);
    RenderSession session(std::move(scene), options);
    const RenderJob job{
        .outputs = outputs, .frames = frames, .options = options, .progress = progress, .scene_hash = hash};
    return frames.is_sequence ? render_frames(command, session, job) : render_picture(command, session, job);
}

}  // namespace voxilux
