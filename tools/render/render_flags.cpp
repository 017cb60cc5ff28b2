#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/error.h"
#include "base/print.h"
#include "open_input.h"
#include "parse_values.h"
#include "render/render.h"
#include "standard_streams.h"

namespace voxilux {
namespace {

constexpr double kCheckpointEvery_s = 60.0;

void add_output_flags(Flags& flags, RenderCommand& command) {
    flags.begin_group("Output");
    add_picture_flag(flags, command.pictures.files,
                     "picture to write, .exr or .png; may repeat; {name} and {camera} are INPUT's and the "
                     "camera's (default: {name}.png, here)");
    flags.add("--sheet", "FILE.png", command.sheet, "a contact sheet of all pictures, too");
    add_report_flags(flags, command.report);
    add_tone_flags(flags, command.pictures.tone);
    flags.add_parsed(
        "--denoise", "on|off", command.denoises, parse_denoise,
        "filter the noise of the picture, and estimate the error that is left, which --error then "
        "looks at; an EXR has both pictures (default off)");
    flags.add_switch("--reproducible", command.pictures.reproducible,
                     "leave date and times out of the files: equal runs write equal bytes");
    add_progress_flag(flags, command.progress);
    flags.add_switch("-v,--verbose", command.verbose,
                     "print the plan too (render), the first frame too (plan)");
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
    for (std::size_t at = text.find(what); at != text.npos; at = text.find(what, at + by.size()))
        text.replace(at, what.size(), by);
    return text;
}

void add_stop_flags(Flags& flags, RenderCommand& command) {
    flags.begin_group("When to stop");
    flags.add_parsed("--error", "E", command.error_target, parse_error_target,
                     "stop when the estimated error is below this, such as 1%; --spp is the maximum");
    flags.add_parsed("--time-limit", "T", command.time_limit_s, parse_duration,
                     "stop in time, such as 90s, 2m or 1h30m; the picture is whole");
}

double checked_interval(double seconds) {
    if (seconds >= 0.0 && std::isfinite(seconds)) return seconds;
    throw Error(ExitCode::usage,
                fmt::format("--checkpoint: {} is not a number of seconds; 0 is none", seconds));
}

void add_part_flags(Flags& flags, RenderCommand& command) {
    flags.begin_group("Parts and checkpoints");
    flags.add_parsed(
        "--samples", "A-B,C-D", command.samples, parse_samples,
        "render these samples only, of 0 and up, for voxilux merge; the EXR has their exact sums");
    flags
        .add_parsed("--shard", "I/N", command.shard, parse_shard,
                    "the same for every Nth sample from the Ith on")
        .excludes("--samples");
    flags.on<double>(
        "--checkpoint", "SECONDS",
        [&command](double seconds) { command.checkpoint_s = checked_interval(seconds); },
        "interval between writes of FILE.exr.part, which take a tenth of the time at most; 0 is "
        "never (default 60)");
    flags.add_switch("--resume", command.resume,
                     "go on from FILE.exr.part, which a killed, interrupted or timed out render left");
}

const char* part_flag(const RenderCommand& command) {
    return command.shard ? "--shard" : "--samples";
}

void refuse_parts_of_a_range(const RenderCommand& command) {
    const auto refuse_flag = [](const char* flag, const char* instead) {
        refuse(fmt::format("{} is for one picture; {}", flag, instead));
    };
    if (is_part(command)) refuse_flag(part_flag(command), "share a frame range by --frames A-B instead");
    if (command.resume) refuse_flag("--resume", "go on with --frames from the first frame that is missing");
    if (command.checkpoint_s) refuse_flag("--checkpoint", "a frame range keeps each frame that is finished");
}

void check_part_flags(const RenderCommand& command, bool writes_exr) {
    if (asks_for_frames(command.scene)) refuse_parts_of_a_range(command);
    if (is_part(command) && command.error_target)
        refuse(fmt::format("{} and --error: the error of the whole picture is not known before voxilux merge",
                           part_flag(command)));
    if (writes_exr) return;
    if (is_part(command))
        refuse(
            fmt::format("{}: its part of the picture goes into an EXR; add -o FILE.exr", part_flag(command)));
    if (command.resume || command.checkpoint_s.value_or(0.0) > 0.0)
        refuse("--resume and --checkpoint: checkpoints lie beside an EXR; add -o FILE.exr");
}

}  // namespace

Flag add_render_flags(Flags& flags, RenderCommand& command) {
    const Flag input = add_scene_flags(flags, command.scene, PicturesOf::inputs);
    add_output_flags(flags, command);
    add_stop_flags(flags, command);
    add_part_flags(flags, command);
    add_device_flags(flags, command.device, command.scene.request.memory_budget_bytes, "the pipeline cache");
    flags.add_parsed("--group-size", "WxH", command.group_size, parse_size,
                     "workgroup of the passes over pixels (default 8x8)");
    return input;
}

bool is_part(const RenderCommand& command) {
    return command.shard || !command.samples.empty();
}

void request_samples(const RenderCommand& command, const Scene& scene, PlanRequest& request) {
    const std::uint32_t spp = scene.settings.spp;
    request.part = command.samples;
    if (command.scene.spp && command.samples.end() > spp)
        refuse(fmt::format("--samples {}: a render of {} samples has 0 to {}", command.samples.text(), spp,
                           spp - 1));
    if (!command.shard) return;
    if (spp > kMaxPartSamples)
        refuse(fmt::format("--shard: sums are exact up to {} samples, these are {}", kMaxPartSamples, spp));
    request.part = SampleSet::shard(command.shard->index, command.shard->count, spp);
    if (request.part.empty())
        refuse(fmt::format("--shard {}/{}: a render of {} samples has no such shard",
                           command.shard->index + 1, command.shard->count, spp));
}

PictureFiles pictures_of(const RenderCommand& command) {
    PictureFiles pictures = command.pictures;
    const bool is_stream = command.scene.input == kStandardStream;
    const std::filesystem::path input = is_stream ? "stdin" : command.scene.input;
    pictures.is_part = is_part(command);
    pictures.scene_name = input.filename().string();
    if (pictures.files.empty())
        pictures.files = {command.scene.cameras.size() > 1 ? "{name}_{camera}.png" : "{name}.png"};
    const std::string camera = command.scene.camera ? command.scene.camera->name : "default";
    for (std::string& file : pictures.files)
        file = replaced(replaced(file, "{name}", input.stem().string()), "{camera}", camera);
    return pictures;
}

Checkpoint checkpoint_of(const RenderCommand& command) {
    Checkpoint checkpoint{.pictures = pictures_of(command),
                          .every_s = command.checkpoint_s.value_or(kCheckpointEvery_s)};
    checkpoint.note = [quiet = command.report.quiet](const std::string& line) {
        if (!quiet) print_message("note: {}\n", line);
    };
    checkpoint.warn = [](const std::string& line) { print_message("warning: {}\n", line); };
    check_part_flags(command, std::ranges::any_of(checkpoint.pictures.files, is_exr));
    if (!asks_for_frames(command.scene)) checkpoint.file = checkpoint_file(checkpoint.pictures);
    return checkpoint;
}

Scene scene_to_render(const RenderCommand& command, StepTimes* times) {
    Scene scene = load_scene_with(command.scene, !command.report.quiet, times);
    if (command.error_target && !command.scene.spp) scene.settings.spp = kMaxSamplesForError;
    return scene;
}

RenderOptions render_options(const RenderCommand& command) {
    RenderOptions options{.plan = command.scene.request,
                          .device = command.device.request(),
                          .time_limit_s = command.time_limit_s,
                          .error_target = command.error_target};
    const std::vector<std::string> files = pictures_of(command).files;
    options.writes_exr = options.plan.effects.wants_aov = std::ranges::any_of(files, is_exr);
    options.writes_png = std::ranges::any_of(files, is_png);
    options.plan.wants_denoised = command.denoises;
    options.executor.cache_dir = command.device.cache_dir();
    options.executor.group_size = {static_cast<std::uint32_t>(command.group_size.x),
                                   static_cast<std::uint32_t>(command.group_size.y)};
    return options;
}

}  // namespace voxilux
