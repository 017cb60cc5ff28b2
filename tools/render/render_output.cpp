#include "render/render_output.h"

#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "base/error.h"
#include "formats/png.h"
#include "frame/footprint.h"
#include "jobs/forecast_history.h"
#include "jobs/report.h"
#include "output_files.h"
#include "parse_values.h"
#include "render/render_part.h"

namespace voxilux {
namespace {

namespace fs = std::filesystem;

ToneMap parse_tone(const std::string& name) {
    if (name == "filmic") return ToneMap::filmic;
    if (name == "plain") return ToneMap::plain;
    throw Error(ExitCode::usage, fmt::format("--tone: '{}' is not filmic or plain", name));
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

}  // namespace

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

nlohmann::ordered_json report_of_picture(const RenderCommand& command, const Scene& scene,
                                         const RenderOutcome& outcome) {
    return command.reproducible ? reproducible_report_json(scene, outcome) : report_json(scene, outcome);
}

ToneMapOptions tone_options(const std::string& curve, float exposure_ev) {
    if (!std::isfinite(exposure_ev))
        throw Error(ExitCode::usage, fmt::format("--exposure: {} is not a number of stops", exposure_ev));
    return {.curve = parse_tone(curve), .exposure_ev = exposure_ev};
}

void write_pictures(const RenderCommand& command, const std::vector<std::string>& outputs, const Scene& scene,
                    RenderOutcome& outcome) {
    outcome.image.attributes[kReportAttribute] = report_of_picture(command, scene, outcome).dump();
    // A shard writes its sums beside its picture.
    const bool is_whole = outcome.plan.shard.is_whole();
    const Image part = is_whole ? Image{} : image_of(part_to_write(command, scene, outcome));
    for (const std::string& file : outputs) {
        if (has_ending(file, ".exr")) {
            const WriteReport written =
                write_exr(file, is_whole ? outcome.image : part, exr_options(command, scene, outcome.plan));
            outcome.statistics.faults["exr_clamped"] += written.clamped;
            outcome.statistics.faults["exr_non_finite"] += written.non_finite;
        } else {
            const DisplayImage display =
                to_display(outcome.image, tone_options(command.tone, command.exposure_ev));
            outcome.statistics.faults["png_nan"] += display.nan;
            write_png(file, display.image);
        }
    }
}

void rehearse_output(const RenderCommand& command, const std::vector<std::string>& outputs,
                     const Scene& scene, RenderOutcome strip) try {
    std::string folder = (fs::temp_directory_path() / "voxilux-XXXXXX").string();
    if (::mkdtemp(folder.data()) == nullptr) return;
    std::vector<std::string> files;
    for (std::size_t i = 0; i < outputs.size(); ++i)
        files.push_back(
            (fs::path(folder) / fmt::format("{}{}", i, fs::path(outputs[i]).extension().string())));
    try {
        leave_checkpoint(command, files, scene, strip);
        write_pictures(command, files, scene, strip);
    } catch (const Error&) {
    }
    fs::remove_all(folder);
} catch (const fs::filesystem_error&) {
}

fs::path history_file() {
    if (const char* named = std::getenv("XDG_STATE_HOME"); named != nullptr && *named != '\0')
        return fs::path(named) / "voxilux" / "forecasts.jsonl";
    if (const char* home = std::getenv("HOME"); home != nullptr && *home != '\0')
        return fs::path(home) / ".local" / "state" / "voxilux" / "forecasts.jsonl";
    return {};
}

void remember_forecast(const RenderCommand& command, const nlohmann::ordered_json& report) {
    if (report.at("forecast").at("low_s").is_null()) return;
    const std::string name = fs::path(command.scene.input).filename().string();
    (void)append_history(history_file(), history_entry(report, name));
}

bool missed_error(const RenderCommand& command, const RenderOutcome& outcome) {
    return command.error && !(outcome.statistics.error.high <= parse_error_target(*command.error));
}

void print_validation(const RenderOutcome& outcome) {
    for (const std::string& message : outcome.statistics.validation)
        fmt::print(stderr, "validation: {}\n", message);
}

void print_faults(const RenderOutcome& outcome) {
    for (const auto& [name, count] : outcome.statistics.faults) {
        if (count != 0) fmt::print(stderr, "warning: fault {} counted {} times\n", name, count);
    }
}

void print_warnings(const RenderCommand& command, const RenderOutcome& outcome, std::set<std::string>& said) {
    if (command.quiet) return;
    for (const std::string& warning : outcome.statistics.warnings) {
        if (said.insert(warning).second) fmt::print(stderr, "warning: {}\n", warning);
    }
    if (command.verbose) return;  // the plan that is printed has them
    for (const std::string& note : outcome.plan.notes) {
        if (said.insert(note).second) fmt::print(stderr, "note: {}\n", note);
    }
}

void print_missed_error(const RenderCommand& command, const RenderOutcome& outcome) {
    if (command.quiet || !missed_error(command, outcome)) return;
    const RenderStatistics& statistics = outcome.statistics;
    fmt::print(stderr,
               "warning: stopped after {} samples with an error of up to {:.3g} %, over the {} asked for\n",
               statistics.samples, 100.0 * statistics.error.high, *command.error);
}

void print_outcome(const RenderCommand& command, const std::vector<std::string>& outputs,
                   const RenderOutcome& outcome) {
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

}  // namespace voxilux
