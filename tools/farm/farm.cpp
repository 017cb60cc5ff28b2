#include "farm/farm.h"

#include <cstdlib>
#include <filesystem>
#include <set>

#include "base/error.h"
#include "base/file.h"
#include "base/json.h"
#include "open_input.h"
#include "parse_values.h"
#include "python.h"
#include "render/render.h"
#include "renderer/prepared_scene.h"
#include "scene/animation.h"
#include "standard_streams.h"
#include "voxelizer/import_voxels.h"

namespace voxilux {
namespace {

using Json = nlohmann::ordered_json;

// Flags that say how much is rendered. The farm divides that among workers, so they are not passed on.
const std::set<std::string> kDealtOut = {"--spp", "--iterations", "--frame", "--frames"};

Json words_json(const Flags::GivenWords& words) {
    Json json = Json::array();
    for (const auto& [name, value] : words) {
        if (kDealtOut.contains(name)) continue;
        json.push_back(name);
        if (!value.empty()) json.push_back(value);
    }
    return json;
}

// Why a frame cannot be divided by samples, so that each is rendered whole; empty when it can.
std::string reason_for_whole_frames(const FarmCommand& command, const Scene& animated, std::int64_t frame) {
    FramePlayer player{Scene(animated)};
    const RenderPlan plan = prepare_scene(player.show(frame), command.scene.request, DeviceLimits{}).plan;
    for (const ChosenTechnique& chosen : plan.techniques) {
        if (!chosen.technique->mergeable()) return std::string(chosen.technique->state);
    }
    return "";
}

Json frames_json_of(const FrameList& frames) {
    Json json = Json::array();
    for (std::int64_t i = 0; i < frames.count(); ++i)
        json.push_back(frames.at(i));
    return json;
}

// The arguments of `convert`; null where the input is rendered as it is.
Json mesh_words_json(const FarmCommand& command) {
    if (!is_importable(command.scene.input)) return nullptr;
    Flags::GivenWords words = command.scene_words();
    std::erase_if(words,
                  [](const auto& word) { return word.first != "--resolution" && word.first != "--up"; });
    return words_json(words);
}

std::string progress_name(ProgressMode mode) {
    return mode == ProgressMode::json ? "json" : mode == ProgressMode::never ? "never" : "auto";
}

Json job_of(const FarmCommand& command) {
    if (command.scene.input == kStandardStream) refuse("farm: the machines need a file, not standard input");
    Scene scene = load_scene_with(command.scene, !command.report.quiet);
    if (command.error_target && !command.scene.spp) scene.settings.spp = kMaxSamplesForError;
    const FrameList frames = frames_to_render(command.scene, scene);
    const std::string binary = std::filesystem::read_symlink("/proc/self/exe").string();
    Json outputs = Json::array();
    for (std::int64_t i = 0; i < frames.count(); ++i)
        outputs.push_back(files_of_frame(command.pictures.files, frames, frames.at(i)));
    return {{"binary", binary},
            {"worker_binary", command.worker_binary.empty() ? binary : command.worker_binary},
            {"scene", std::filesystem::absolute(command.scene.input).string()},
            {"mesh_words", mesh_words_json(command)},
            {"overrides", command.scene.overrides},
            {"words", words_json(command.scene_words())},
            {"device", command.device},
            {"tone_words", words_json(command.tone_words())},
            {"outputs", outputs},
            {"job", command.pictures.files.front() + ".farm"},
            {"frames", frames_json_of(frames)},
            {"is_animation", frames.is_sequence || command.scene.frame.has_value()},
            {"spp", scene.settings.spp},
            {"whole_frames", reason_for_whole_frames(command, scene, frames.first)},
            {"error", command.error_target ? Json(*command.error_target) : Json(nullptr)},
            {"time_limit_s", command.time_limit_s ? Json(*command.time_limit_s) : Json(nullptr)},
            {"scheduler", command.scheduler},
            {"workers", command.workers ? Json(*command.workers) : Json(nullptr)},
            {"resume", command.resume},
            {"allow_mixed_devices", command.allow_mixed_devices},
            {"quiet", command.report.quiet},
            {"progress", progress_name(command.progress)},
            {"json", command.report.json}};
}

void check_command(const FarmCommand& command) {
    if (command.pictures.files.empty()) refuse("farm: -o FILE is missing: where the picture goes");
    if (command.workers && *command.workers < 1) refuse("--workers: a number from 1 up");
    if (command.workers && !command.scheduler.empty())
        refuse("--workers is for a cluster of this machine; that of --scheduler has its own");
    std::vector<std::string> outputs = command.pictures.files;
    outputs.push_back(command.report.json);
    check_outputs(outputs, {command.scene.input});
}

}  // namespace

void add_farm_flags(Flags& flags, FarmCommand& command) {
    add_scene_flags(flags, command.scene).required();
    add_device_flag(flags, command.device);
    command.scene_words = flags.given();
    flags.begin_group("Output");
    add_tone_flags(flags, command.pictures.tone);
    command.tone_words = [all = flags.given(), scene = command.scene_words] {
        Flags::GivenWords words = all();
        words.erase(words.begin(), words.begin() + static_cast<std::ptrdiff_t>(scene().size()));
        return words;
    };
    add_picture_flag(flags, command.pictures.files, "picture to write, .exr or .png; may repeat");
    add_report_flags(flags, command.report);
    add_progress_flag(flags, command.progress);
    flags.begin_group("When to stop");
    flags.add_parsed("--error", "E", command.error_target, parse_error_target,
                     "stop when the estimated error of the whole picture is below, such as 1%");
    flags.add_parsed("--time-limit", "T", command.time_limit_s, parse_duration,
                     "stop in time, such as 90s, 2m or 1h30m; the picture is that of the samples so far");
    flags.begin_group("Cluster");
    flags.add("--scheduler", "ADDRESS", command.scheduler,
              "a Dask scheduler, such as tcp://host:8786; without one, workers of this machine alone");
    flags.add("--workers", "N", command.workers,
              "of this machine (default: one per GPU, or per 8 cores without one)");
    flags.add("--worker-binary", "FILE", command.worker_binary,
              "the voxilux of the workers (default: the path of this one); it must be the same build");
    flags.add_switch("--resume", command.resume, "go on with the job in the folder FILE.farm");
    flags.add_switch(
        "--allow-mixed-devices", command.allow_mixed_devices,
        "use workers with other kinds of devices, too: the picture is as accurate, but its bytes are "
        "those of no single render");
}

int run_farm(const FarmCommand& command) {
    check_command(command);
    const Json job = job_of(command);
    const std::string python = python_with({"dask", "distributed", "tomllib"});
    if (python.empty())
        throw Error(ExitCode::no_device,
                    "farm: there is no python3 of version 3.11 or later with dask and distributed: apt-get "
                    "install python3-distributed, or pip install dask distributed");
    become_python(python, farm_source(), json_text(job));
}

}  // namespace voxilux
