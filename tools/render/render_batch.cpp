#include "render/render_batch.h"

#include <algorithm>
#include <set>

#include "base/error.h"
#include "base/file.h"
#include "base/print.h"
#include "formats/png.h"
#include "interrupt.h"
#include "jobs/contact_sheet.h"
#include "jobs/report.h"
#include "parse_values.h"
#include "render/print_render.h"
#include "render/render_job.h"
#include "scene/scene_hash.h"
#include "write_json.h"

namespace voxilux {
namespace {

// What the pictures of a batch share, and the results so far.
struct Batch {
    std::optional<RenderSession> session;
    ProgressLine progress;
    std::set<std::string> said;
    std::vector<std::string> pngs;
    nlohmann::ordered_json reports = nlohmann::ordered_json::array();
    ExitCode code = ExitCode::done;
};

// A command for each input and camera.
std::vector<RenderCommand> commands_of(const RenderCommand& command) {
    std::vector<std::optional<CameraChoice>> cameras(command.scene.cameras.begin(),
                                                     command.scene.cameras.end());
    if (cameras.empty()) cameras.emplace_back();
    std::vector<RenderCommand> commands;
    for (const std::string& input : command.scene.inputs) {
        for (const std::optional<CameraChoice>& camera : cameras) {
            RenderCommand one = command;
            one.scene.input = input;
            one.scene.camera = camera;
            one.report.json.clear();
            if (!asks_for_frames(one.scene)) one.checkpoint_s = 0.0;
            commands.push_back(std::move(one));
        }
    }
    return commands;
}

void check_batch(const RenderCommand& command, const std::vector<RenderCommand>& commands) {
    if (is_part(command) || command.resume || command.checkpoint_s)
        refuse(
            "--samples, --shard, --resume and --checkpoint are for one picture; render the inputs one by "
            "one");
    std::set<std::string> names;
    std::vector<std::string> files = {command.report.json, command.sheet};
    for (const RenderCommand& one : commands) {
        const std::vector<std::string> pictures = pictures_of(one).files;
        for (const std::string& file : pictures) {
            if (!names.insert(file).second)
                refuse(fmt::format("two pictures would be written to {}; put {{name}} or {{camera}} into -o",
                                   file));
        }
        const std::vector<std::string> written = files_to_write(one, pictures);
        files.insert(files.end(), written.begin(), written.end());
    }
    if (!command.sheet.empty() && !is_png(command.sheet))
        refuse(fmt::format("--sheet {}: the ending must be .png", command.sheet));
    if (!command.sheet.empty() && std::ranges::none_of(names, is_png))
        refuse("--sheet: it shows the PNGs of the pictures; add -o FILE.png");
    check_outputs(files, command.scene.inputs);
}

void add_pngs(const std::vector<std::string>& files, Batch& batch) {
    const auto png = std::ranges::find_if(files, is_png);
    if (png != files.end()) batch.pngs.push_back(*png);
}

// One line for a picture.
void print_picture(const RenderCommand& command, const std::vector<std::string>& files,
                   const RenderStatistics& statistics) {
    if (!command.report.prints()) return;
    const std::string error =
        statistics.error.is_known() ? fmt::format("{:.3g}", statistics.error.estimate) : "unknown";
    print_result("picture   {:.2f} s, {} samples, error {}  {}\n", statistics.wall_s, statistics.samples,
                 error, fmt::join(files, " "));
    std::fflush(stdout);  // whoever waits for a picture reads it now
}

ExitCode render_still(const RenderCommand& command, const RenderJob& job, Batch& batch) {
    RenderOutcome outcome =
        batch.session->render(job.range.frames.first, command.time_limit_s, batch.progress.callback());
    batch.progress.finish();
    const PictureFiles& pictures = job.checkpoint.pictures;
    if (outcome.statistics.stop == StopReason::interrupted) return ExitCode::interrupted;
    write_pictures(pictures, batch.session->scene(), outcome);
    print_validation(outcome);
    print_faults(outcome);
    print_warnings(command, outcome, batch.said);
    print_picture(command, pictures.files, outcome.statistics);
    batch.reports.push_back(report_json(batch.session->scene(), outcome));
    add_pngs(pictures.files, batch);
    return exit_code(command, outcome);
}

ExitCode render_one(const RenderCommand& command, Batch& batch) {
    const Checkpoint checkpoint = checkpoint_of(command);
    RenderOptions options = render_options(command);
    options.interrupted = &interrupted_by_signal();
    Scene scene = scene_to_render(command);
    const FrameList frames = frames_to_render(command.scene, scene);
    const std::uint64_t hash = frames.is_sequence ? sample_hash(scene) : 0;
    request_frames(scene, frames, options.plan);
    if (batch.session)
        batch.session->load(std::move(scene), options.plan);
    else
        batch.session.emplace(std::move(scene), options);
    const RenderJob job{.checkpoint = checkpoint,
                        .range = {frames, options.time_limit_s, options.started},
                        .progress = batch.progress,
                        .scene_hash = hash};
    if (!frames.is_sequence) return render_still(command, job, batch);
    RenderedFrames rendered = render_frames(command, *batch.session, job);
    for (std::int64_t i = 0; i < rendered.count; ++i)
        add_pngs(files_of_frame(checkpoint.pictures.files, frames, frames.at(i)), batch);
    batch.reports.push_back(std::move(rendered.report));
    return rendered.code;
}

// Exit codes that every later picture would have, too.
bool ends_batch(ExitCode code) {
    return code == ExitCode::no_device || code == ExitCode::device_lost || code == ExitCode::interrupted;
}

void take_error(const RenderCommand& command, const Error& error, Batch& batch) {
    const std::string what = error.what();
    const bool names_file = what.starts_with(command.scene.input);
    print_message("voxilux: {}{}\n", names_file ? "" : command.scene.input + ": ", what);
    if (batch.code == ExitCode::done) batch.code = error.code();
}

void render_all(const std::vector<RenderCommand>& commands, Batch& batch) {
    for (const RenderCommand& one : commands) {
        try {
            const ExitCode code = render_one(one, batch);
            if (batch.code == ExitCode::done || ends_batch(code)) batch.code = code;
            if (ends_batch(code)) return;
        } catch (const Error& error) {
            if (ends_batch(error.code())) throw;
            take_error(one, error, batch);
        }
    }
}

// The reports, and the sheet of the pictures that are there.
void write_rest(const RenderCommand& command, const Batch& batch) {
    write_json(command.report.json, batch.reports);
    if (command.sheet.empty() || batch.pngs.empty()) return;
    write_png(command.sheet, contact_sheet(batch.pngs));
    if (command.report.prints())
        print_result("sheet     {} pictures  {}\n", batch.pngs.size(), command.sheet);
}

}  // namespace

bool is_batch(const RenderCommand& command) {
    return command.scene.inputs.size() > 1 || command.scene.cameras.size() > 1 || !command.sheet.empty();
}

int render_batch(const RenderCommand& command) {
    const std::vector<RenderCommand> commands = commands_of(command);
    check_batch(command, commands);
    Batch batch{.progress = ProgressLine(command.progress, command.report.quiet)};
    try {
        render_all(commands, batch);
    } catch (const Error&) {
        if (!batch.reports.empty()) write_rest(command, batch);
        throw;
    }
    write_rest(command, batch);
    return static_cast<int>(batch.code);
}

}  // namespace voxilux
