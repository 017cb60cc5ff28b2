#include "base/error.h"
#include "output_files.h"
#include "render/render.h"
#include "render/render_part.h"

namespace voxilux {
namespace {

namespace fs = std::filesystem;

constexpr const char* kStop = "When to stop";
constexpr const char* kOutput = "Output";
constexpr const char* kParts = "Parts and checkpoints";

void add_output_flags(CLI::App& command, RenderCommand& options) {
    command
        .add_option("-o,--output", options.outputs,
                    "picture to write, .exr or .png; may repeat (default: INPUT's name .png, here)")
        ->type_name("FILE")
        ->take_all()
        ->allow_extra_args(false)
        ->group(kOutput);
    command.add_option("--json", options.json, "write the report as JSON; - is standard output")
        ->type_name("FILE")
        ->group(kOutput);
    command.add_option("--tone", options.tone, "tone curve of a PNG: filmic or plain (default filmic)")
        ->type_name("NAME")
        ->group(kOutput);
    command.add_option("--exposure", options.exposure_ev, "exposure of a PNG in stops (default 0)")
        ->type_name("EV")
        ->group(kOutput);
    command
        .add_flag("--reproducible", options.reproducible,
                  "no date or times in the files: equal runs, equal bytes")
        ->group(kOutput);
    command
        .add_option("--progress", options.progress,
                    "progress on standard error: auto (if a terminal), never or json")
        ->type_name("HOW")
        ->group(kOutput);
    command.add_flag("-q,--quiet", options.quiet, "print errors only")->group(kOutput);
    command
        .add_flag("-v,--verbose", options.verbose, "print the plan too (render), the first frame too (plan)")
        ->group(kOutput);
}

void add_machine_flags(CLI::App& command, RenderCommand& options) {
    add_device_flags(command, options.device, options.scene.memory_budget_mib, "the pipeline cache");
    command
        .add_option("--group-size", options.group_size, "workgroup of the passes over pixels (default 8x8)")
        ->type_name("WxH")
        ->group(kDeviceGroup);
}

void add_part_flags(CLI::App& command, RenderCommand& options) {
    command
        .add_option("--shard", options.shard,
                    "render every Nth sample from the Ith on, for voxilux merge; the EXR has its exact sums")
        ->type_name("I/N")
        ->group(kParts);
    command
        .add_option("--checkpoint", options.checkpoint_s,
                    "write FILE.exr.part as often while FILE.exr is rendered; 0 is never (default 60)")
        ->type_name("SECONDS")
        ->group(kParts);
    command
        .add_flag("--resume", options.resume,
                  "go on from FILE.exr.part, which a killed, interrupted or timed out render left")
        ->group(kParts);
}

bool is_exr(const std::string& file) {
    return has_ending(file, ".exr");
}

}  // namespace

void add_render_flags(CLI::App& command, RenderCommand& options) {
    add_scene_flags(command, options.scene);
    add_output_flags(command, options);
    command
        .add_option("--error", options.error,
                    "stop when the estimated error is below, such as 1%; --spp is the most")
        ->type_name("E")
        ->group(kStop);
    command
        .add_option("--time-limit", options.time_limit,
                    "stop in time, such as 90s, 2m or 1h30m; the picture is whole")
        ->type_name("T")
        ->group(kStop);
    add_part_flags(command, options);
    add_machine_flags(command, options);
}

std::vector<std::string> output_files(const RenderCommand& command) {
    if (command.outputs.empty()) return {fs::path(command.scene.input).stem().string() + ".png"};
    for (const std::string& file : command.outputs) {
        if (!is_exr(file) && !has_ending(file, ".png"))
            throw Error(ExitCode::usage, fmt::format("-o {}: the ending must be .exr or .png", file));
    }
    return command.outputs;
}

Scene scene_to_render(const RenderCommand& command) {
    Scene scene = load_scene_with(command.scene);
    if (command.error && !command.scene.spp && !command.scene.iterations)
        scene.settings.spp = kMostSamplesForError;
    return scene;
}

PlanRequest request_of(const RenderCommand& command, const std::vector<std::string>& outputs) {
    PlanRequest request = plan_request(command.scene);
    request.shard = shard_of(command);
    request.effects.wants_aov = std::ranges::any_of(outputs, is_exr);
    return request;
}

}  // namespace voxilux
