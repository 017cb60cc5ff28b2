#include "render/render.h"

#include <filesystem>
#include <utility>

#include "base/error.h"
#include "base/file.h"
#include "interrupt.h"
#include "jobs/forecast_history.h"
#include "jobs/memory_forecast.h"
#include "jobs/report.h"
#include "parse_values.h"
#include "render/print_render.h"
#include "render/render_batch.h"
#include "render/render_job.h"
#include "scene/scene_hash.h"
#include "write_json.h"

namespace voxilux {

// A picture that nobody named must not replace one that somebody kept.
std::vector<std::string> files_to_write(const RenderCommand& command,
                                        const std::vector<std::string>& outputs) {
    std::vector<std::string> files;
    const FrameList frames = frames_asked_for(command.scene);
    for (std::int64_t i = 0; i < frames.count(); ++i) {
        for (const std::string& file : files_of_frame(outputs, frames, frames.at(i))) {
            if (command.pictures.files.empty() && std::filesystem::exists(file)) {
                throw Error(
                    ExitCode::usage,
                    fmt::format("render: no -o was given and {} is there already; -o {} overwrites it", file,
                                outputs.front()));
            }
            files.push_back(file);
        }
    }
    return files;
}

namespace {

// A part that is there already, whole and undamaged: nothing is left to do.
bool is_finished(const RenderCommand& command, RenderSession& session, const RenderJob& job) {
    const PictureFiles& pictures = job.checkpoint.pictures;
    if (!pictures.is_part || pictures.files.size() != 1) return false;
    const std::string& file = pictures.files.front();
    const RenderPlan& plan = session.plan_of(job.range.frames.first);
    const auto part = finished_part(file, render_key(session.scene(), plan, session.device()), plan.part);
    if (!part) return false;
    if (!command.report.quiet) print_message("note: {} has these samples already\n", file);
    write_json(command.report.json, part->report);
    return true;
}

int render_picture(const RenderCommand& command, RenderSession& session, const RenderJob& job) {
    if (is_finished(command, session, job)) return static_cast<int>(ExitCode::done);
    RenderOutcome outcome =
        session.render(job.range.frames.first, job.range.time_limit_s, job.progress.callback());
    job.progress.finish();
    if (outcome.statistics.stop == StopReason::interrupted && outcome.statistics.first_pixel_s == 0.0)
        throw Error(ExitCode::interrupted, "interrupted before the first pixels; nothing was written");
    leave_checkpoint(job.checkpoint, session.scene(), outcome);
    write_pictures(job.checkpoint.pictures, session.scene(), outcome);
    remove_checkpoint(job.checkpoint, outcome);
    outcome.statistics.peak_rss_mib = static_cast<double>(resident_bytes().peak) / 0x1p20;
    for (const std::string& message : session.end())
        outcome.statistics.validation.push_back(message);
    print_validation(outcome);
    print_faults(outcome);
    std::set<std::string> said;
    print_warnings(command, outcome, said);
    print_missed_error(command, outcome);
    print_outcome(command, job.checkpoint.pictures.files, outcome);
    const nlohmann::ordered_json report = report_json(session.scene(), outcome);
    write_json(command.report.json, report);
    remember_forecast(report, job.checkpoint.pictures.scene_name);
    return static_cast<int>(exit_code(command, outcome));
}

}  // namespace

int run_render(const RenderCommand& command) {
    if (is_batch(command)) return render_batch(command);
    Checkpoint checkpoint = checkpoint_of(command);
    RenderOptions options = render_options(command);
    use_checkpoint(checkpoint, command.resume, options);
    options.interrupted = &interrupted_by_signal();
    options.checkpoint_wanted = &checkpoint_wanted_by_signal();
    ProgressLine progress(command.progress, command.report.quiet);
    std::vector<std::string> outputs = files_to_write(command, checkpoint.pictures.files);
    outputs.push_back(command.report.json);
    check_outputs(outputs, {command.scene.input});
    StepTimes times;
    Scene scene = scene_to_render(command, &times);
    options.steps = times.steps();
    const FrameList frames = frames_to_render(command.scene, scene);
    if (!command.report.quiet) print_frame_note(command.scene, scene);
    const std::uint64_t hash = frames.is_sequence ? sample_hash(scene) : 0;
    request_frames(scene, frames, options.plan);
    request_samples(command, scene, options.plan);
    if (command.shard || command.scene.spp) checkpoint.pictures.spp = scene.settings.spp;
    RenderSession session(std::move(scene), options);
    const RenderJob job{.checkpoint = checkpoint,
                        .range = {frames, options.time_limit_s, options.started},
                        .progress = progress,
                        .scene_hash = hash};
    if (!frames.is_sequence) return render_picture(command, session, job);
    const RenderedFrames rendered = render_frames(command, session, job);
    write_json(command.report.json, rendered.report);
    return static_cast<int>(rendered.code);
}

}  // namespace voxilux
