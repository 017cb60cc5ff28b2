#include "render/render.h"

#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>

#include "base/error.h"
#include "film/exr.h"
#include "film/png.h"
#include "film/tonemap.h"
#include "output_files.h"
#include "parse_values.h"
#include "render/progress_line.h"
#include "session/report.h"

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
    if (command.outputs.empty() && fs::exists(outputs.front())) {
        throw Error(ExitCode::usage,
                    fmt::format("render: no -o was given and {0} is there already; -o {0} overwrites it",
                                outputs.front()));
    }
    for (const std::string& file : outputs)
        check_writable(file);
    check_writable(command.json);
}

ToneMap parse_tone(const std::string& name) {
    if (name == "filmic") return ToneMap::filmic;
    if (name == "plain") return ToneMap::plain;
    throw Error(ExitCode::usage, fmt::format("--tone: '{}' is not filmic or plain", name));
}

ToneMapOptions tone_options(const RenderCommand& command) {
    if (!std::isfinite(command.exposure_ev))
        throw Error(ExitCode::usage,
                    fmt::format("--exposure: {} is not a number of stops", command.exposure_ev));
    return {.curve = parse_tone(command.tone), .exposure_ev = command.exposure_ev};
}

fs::path cache_folder() {
    if (const char* named = std::getenv("XDG_CACHE_HOME"); named != nullptr && *named != '\0')
        return fs::path(named) / "voxilux";
    if (const char* home = std::getenv("HOME"); home != nullptr && *home != '\0')
        return fs::path(home) / ".cache" / "voxilux";
    return {};
}

RenderOptions render_options(const RenderCommand& command, const std::vector<std::string>& outputs) {
    RenderOptions options;
    options.plan = request_of(command, outputs);
    options.device = {.selector = command.device, .validation = command.validation && !command.no_validation};
    if (!command.no_cache) options.executor.cache_dir = cache_folder();
    const glm::ivec2 group = parse_size("--group-size", command.group_size);
    options.executor.group_size = {static_cast<std::uint32_t>(group.x), static_cast<std::uint32_t>(group.y)};
    if (command.time_limit) options.time_limit_s = parse_duration(*command.time_limit);
    if (command.error) options.error_target = parse_error_target(*command.error);
    options.interrupted = &interrupted;
    return options;
}

// Acting on scene points: the camera's right, up and backward axes, as OpenEXR's worldToCamera.
glm::dmat4 world_to_camera(const Camera& camera) {
    const glm::dmat3 basis = camera_basis(camera);
    const glm::dmat3 axes(basis[0], basis[1], -basis[2]);
    glm::dmat4 matrix(glm::transpose(axes));
    matrix[3] = glm::dvec4(-(glm::transpose(axes) * camera.position), 1.0);
    return matrix;
}

// Acting on camera points: x and y in [-1, 1] over the picture after the division by w, z up to 1 far away.
glm::dmat4 camera_to_ndc(const Camera& camera, glm::ivec2 size) {
    const double up = 1.0 / std::tan(glm::radians(camera.fov_y_deg) / 2.0);
    glm::dmat4 matrix(0.0);
    matrix[0][0] = up * static_cast<double>(size.y) / static_cast<double>(size.x);
    matrix[1][1] = up;
    matrix[2][2] = -1.0;
    matrix[2][3] = -1.0;
    matrix[3][2] = -1.0;  // the near plane, z = -1, is one voxel away
    return matrix;
}

ExrOptions exr_options(const RenderCommand& command, const Scene& scene, const RenderPlan& plan) {
    const Camera camera = camera_of(scene);
    const glm::dmat4 to_camera = world_to_camera(camera);
    return {.window = {plan.first_pixel.x, plan.first_pixel.y, plan.image_size.x, plan.image_size.y},
            .reproducible = command.reproducible,
            .software = "voxilux " VX_VERSION,
            .comments = fs::path(command.scene.input).filename().string(),
            .world_to_camera = glm::mat4(to_camera),
            .world_to_ndc = glm::mat4(camera_to_ndc(camera, plan.image_size) * to_camera)};
}

void write_pictures(const RenderCommand& command, const std::vector<std::string>& outputs, const Scene& scene,
                    RenderOutcome& outcome) {
    const nlohmann::ordered_json report =
        command.reproducible ? reproducible_report_json(scene, outcome) : report_json(scene, outcome);
    outcome.image.attributes["voxilux.report"] = report.dump();
    for (const std::string& file : outputs) {
        if (has_ending(file, ".exr")) {
            const WriteReport written =
                write_exr(file, outcome.image, exr_options(command, scene, outcome.plan));
            outcome.statistics.faults["exr_clamped"] += written.clamped;
            outcome.statistics.faults["exr_non_finite"] += written.non_finite;
        } else {
            const DisplayImage display = to_display(outcome.image, tone_options(command));
            outcome.statistics.faults["png_nan"] += display.nan;
            write_png(file, display.image);
        }
    }
}

bool missed_error(const RenderCommand& command, const RenderOutcome& outcome) {
    return command.error && !(outcome.statistics.error.high <= parse_error_target(*command.error));
}

// What went wrong or may surprise, on standard error. Faults and validation messages are mistakes of ours:
// they are said whatever the user asked for.
void print_warnings(const RenderCommand& command, const RenderOutcome& outcome) {
    const RenderStatistics& statistics = outcome.statistics;
    for (const std::string& message : statistics.validation)
        fmt::print(stderr, "validation: {}\n", message);
    for (const auto& [name, count] : statistics.faults) {
        if (count != 0) fmt::print(stderr, "warning: fault {} counted {} times\n", name, count);
    }
    if (command.quiet) return;
    for (const std::string& warning : statistics.warnings)
        fmt::print(stderr, "warning: {}\n", warning);
    if (!command.verbose) {
        for (const std::string& note : outcome.plan.notes)
            fmt::print(stderr, "note: {}\n", note);
    }
    if (missed_error(command, outcome)) {
        fmt::print(
            stderr,
            "warning: stopped after {} samples with an error of up to {:.3g} %, over the {} asked for\n",
            statistics.samples, 100.0 * statistics.error.high, *command.error);
    }
}

void print_outcome(const RenderCommand& command, const std::vector<std::string>& outputs,
                   const RenderOutcome& outcome) {
    print_warnings(command, outcome);
    if (command.quiet || command.json == "-") return;
    if (command.verbose) fmt::print("{}", describe(outcome.plan));
    fmt::print("{}", describe(outcome));
    for (const std::string& file : outputs)
        fmt::print("wrote     {}\n", file);
}

ExitCode exit_code(const RenderCommand& command, const RenderOutcome& outcome) {
    if (outcome.statistics.stop == StopReason::interrupted) return ExitCode::interrupted;
    const bool out_of_time = outcome.statistics.stop == StopReason::time_limit;
    return out_of_time && missed_error(command, outcome) ? ExitCode::time_limit : ExitCode::done;
}

}  // namespace

CLI::App* add_render(CLI::App& app, RenderCommand& command) {
    CLI::App* render = app.add_subcommand("render", "render a scene to EXR and PNG");
    add_render_flags(*render, command);
    return render;
}

int run_render(const RenderCommand& command) {
    const std::vector<std::string> outputs = output_files(command);
    RenderOptions options = render_options(command, outputs);
    ProgressLine progress(command.progress, command.quiet);
    (void)tone_options(command);
    check_outputs(command, outputs);
    std::signal(SIGINT, on_interrupt);
    std::signal(SIGTERM, on_interrupt);
    const Scene scene = scene_to_render(command);
    RenderOutcome outcome = render_scene(scene, options, progress.callback());
    progress.finish();
    if (outcome.statistics.stop == StopReason::interrupted && outcome.statistics.first_pixel_s == 0.0)
        throw Error(ExitCode::interrupted, "interrupted before the first pixels; nothing was written");
    write_pictures(command, outputs, scene, outcome);
    print_outcome(command, outputs, outcome);
    write_json(command.json, report_json(scene, outcome));
    return static_cast<int>(exit_code(command, outcome));
}

}  // namespace voxilux
