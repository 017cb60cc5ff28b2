#include "render/render.h"

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <iostream>

#include "base/error.h"
#include "base/file.h"
#include "film/exr.h"
#include "film/png.h"
#include "film/tonemap.h"
#include "render/progress_line.h"
#include "scene/scene_camera.h"
#include "session/report.h"

namespace voxilux {
namespace {

namespace fs = std::filesystem;

std::atomic<bool> interrupted = false;
static_assert(std::atomic<bool>::is_always_lock_free);

void on_interrupt(int) {
    interrupted = true;
}

bool is_exr(const std::string& file) {
    return fs::path(file).extension() == ".exr";
}

void check_outputs(const std::vector<std::string>& outputs) {
    if (outputs.empty()) throw Error(ExitCode::usage, "render: no output; give -o FILE.exr or -o FILE.png");
    for (const std::string& file : outputs) {
        if (!is_exr(file) && fs::path(file).extension() != ".png")
            throw Error(ExitCode::usage, fmt::format("-o {}: the ending must be .exr or .png", file));
        const fs::path folder = fs::absolute(fs::path(file)).parent_path();
        if (!fs::is_directory(folder))
            throw Error(ExitCode::cannot_write, fmt::format("{}: the folder {} does not exist", file, folder.string()));
    }
}

ToneMap parse_tone(const std::string& name) {
    if (name == "filmic") return ToneMap::filmic;
    if (name == "plain") return ToneMap::plain;
    throw Error(ExitCode::usage, fmt::format("--tone: '{}' is not filmic or plain", name));
}

fs::path cache_folder() {
    if (const char* named = std::getenv("XDG_CACHE_HOME"); named != nullptr && *named != '\0')
        return fs::path(named) / "voxilux";
    if (const char* home = std::getenv("HOME"); home != nullptr && *home != '\0')
        return fs::path(home) / ".cache" / "voxilux";
    return {};
}

RenderOptions render_options(const RenderCommand& command) {
    RenderOptions options;
    options.plan = plan_request(command.scene);
    options.plan.effects.wants_aov = std::ranges::any_of(command.outputs, is_exr);
    options.device = {.selector = command.scene.device, .validation = command.validation};
    if (!command.no_cache) options.executor.cache_dir = cache_folder();
    const glm::ivec2 group = parse_size(command.group_size);
    options.executor.group_size = {static_cast<std::uint32_t>(group.x), static_cast<std::uint32_t>(group.y)};
    if (command.time_limit) options.time_limit_s = parse_duration(*command.time_limit);
    if (command.error) options.error_target = parse_error_target(*command.error);
    options.interrupted = &interrupted;
    return options;
}

// Rows of the matrix that takes scene points to the camera's right, up and backward axes, as OpenEXR's worldToCamera.
glm::mat4 world_to_camera(const Camera& camera) {
    const glm::dmat3 basis = camera_basis(camera);
    const glm::dmat3 axes(basis[0], basis[1], -basis[2]);
    glm::dmat4 matrix(glm::transpose(axes));
    matrix[3] = glm::dvec4(-(glm::transpose(axes) * camera.position), 1.0);
    return glm::mat4(matrix);
}

void write_pictures(const RenderCommand& command, const Scene& scene, RenderOutcome& outcome) {
    const nlohmann::ordered_json report = command.reproducible ? reproducible_report_json(scene, outcome)
                                                               : report_json(scene, outcome);
    outcome.image.attributes["voxilux.report"] = report.dump();
    for (const std::string& file : command.outputs) {
        if (is_exr(file)) {
            const WriteReport written = write_exr(file, outcome.image,
                                                  {.reproducible = command.reproducible,
                                                   .world_to_camera = world_to_camera(camera_of(scene))});
            outcome.statistics.faults["exr_clamped"] += written.clamped;
            outcome.statistics.faults["exr_non_finite"] += written.non_finite;
        } else {
            const DisplayImage display =
                to_display(outcome.image, {.curve = parse_tone(command.tone), .exposure_ev = command.exposure_ev});
            outcome.statistics.faults["png_nan"] += display.nan;
            write_png(file, display.image);
        }
    }
}

void print_outcome(const RenderCommand& command, const RenderOutcome& outcome) {
    for (const std::string& warning : outcome.statistics.warnings)
        fmt::print(stderr, "warning: {}\n", warning);
    for (const std::string& message : outcome.statistics.validation)
        fmt::print(stderr, "validation: {}\n", message);
    for (const auto& [name, count] : outcome.statistics.faults) {
        if (count != 0) fmt::print(stderr, "warning: fault {} counted {} times\n", name, count);
    }
    if (command.quiet || command.scene.json == "-") return;
    if (command.verbose) fmt::print("{}", describe(outcome.plan));
    fmt::print("{}", describe(outcome));
    for (const std::string& file : command.outputs)
        fmt::print("wrote     {}\n", file);
}

ExitCode exit_code(const RenderCommand& command, const RenderOutcome& outcome) {
    if (outcome.statistics.stop == StopReason::interrupted) return ExitCode::interrupted;
    const bool missed = command.error && outcome.statistics.stop != StopReason::error_target;
    if (outcome.statistics.stop == StopReason::time_limit && missed) return ExitCode::time_limit;
    return ExitCode::done;
}

}  // namespace

CLI::App* add_render(CLI::App& app, RenderCommand& command) {
    CLI::App* render = app.add_subcommand("render", "render a scene to EXR and PNG");
    add_scene_flags(*render, command.scene);
    render->add_option("-o,--output", command.outputs, "FILE.exr or FILE.png; may repeat");
    render->add_option("--time-limit", command.time_limit, "stop in time, such as 90s; exit 4 when --error is not met");
    render->add_option("--error", command.error, "stop when the estimated error is below, such as 1%");
    render->add_option("--progress", command.progress, "auto, never or json, on standard error")->capture_default_str();
    render->add_option("--tone", command.tone, "tone curve of a PNG: filmic or plain")->capture_default_str();
    render->add_option("--exposure", command.exposure_ev, "exposure of a PNG in stops")->capture_default_str();
    render->add_option("--group-size", command.group_size, "workgroup of the pixel passes, WxH")->capture_default_str();
    render->add_flag("--reproducible", command.reproducible, "leave date and times out of the EXR: equal runs, equal bytes");
    render->add_flag("--validation,!--no-validation", command.validation, "run under the Vulkan validation layers");
    render->add_flag("--no-cache", command.no_cache, "neither read nor write the pipeline cache");
    render->add_flag("-q,--quiet", command.quiet, "print errors only");
    render->add_flag("-v,--verbose", command.verbose, "print the plan too");
    return render;
}

int run_render(const RenderCommand& command) {
    check_outputs(command.outputs);
    const auto on_progress = progress_printer(command.progress, command.quiet);
    const RenderOptions options = render_options(command);
    parse_tone(command.tone);
    std::signal(SIGINT, on_interrupt);
    std::signal(SIGTERM, on_interrupt);
    const Scene scene = load_scene_with(command.scene);
    RenderOutcome outcome = render_scene(scene, options, on_progress);
    finish_progress(command.progress, command.quiet);
    write_pictures(command, scene, outcome);
    print_outcome(command, outcome);
    write_json(command.scene.json, report_json(scene, outcome));
    return static_cast<int>(exit_code(command, outcome));
}

}  // namespace voxilux
