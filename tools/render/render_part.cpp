#include "render/render_part.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "output_files.h"
#include "parse_values.h"
#include "render/render_output.h"

namespace voxilux {
namespace {

namespace fs = std::filesystem;

constexpr double kCheckpointEvery_s = 60.0;

double checkpoint_seconds(const RenderCommand& command) {
    return command.checkpoint_s.value_or(kCheckpointEvery_s);
}

bool is_exr(const std::string& file) {
    return has_ending(file, ".exr");
}

bool is_finished(const RenderOutcome& outcome) {
    const StopReason stop = outcome.statistics.stop;
    return stop == StopReason::finished || stop == StopReason::error_target;
}

// The picture is what counts: a checkpoint that cannot be written is no reason to stop. Samples that depend
// on those before cannot be gone on from.
void save_checkpoint(const RenderCommand& command, const fs::path& file, const Scene& scene,
                     RenderOutcome outcome) {
    if (outcome.plan.any(&Technique::keeps_state)) return;
    try {
        FilmPart part = part_to_write(command, scene, std::move(outcome));
        const ExrOptions options = part.file;
        (void)write_exr(file, image_of(std::move(part)), options);
    } catch (const Error& error) {
        fmt::print(stderr, "warning: no checkpoint: {}\n", error.what());
    }
}

void check_goes_on(const FilmPart& part, const Scene& scene, const RenderPlan& plan, const fs::path& file) {
    const auto refuse = [&](const std::string& why) {
        throw Error(ExitCode::input_refused,
                    fmt::format("{}: cannot go on from it: {}; without --resume the render starts anew",
                                file.string(), why));
    };
    if (const auto other = difference(part.render, render_key(scene, plan))) refuse(*other);
    const auto [index, samples] = *part.done.begin();
    if (part.done.size() != 1 || Shard{index, part.shards} != plan.shard)
        refuse(fmt::format("it is of shard {}/{}", index + 1, part.shards));
    if (samples + (part.rows_ahead > 0 ? 1 : 0) > plan.samples())
        refuse(fmt::format("it has more than {} samples already", plan.samples()));
}

FilmStart resume_from(const RenderCommand& command, const fs::path& file, const Scene& scene,
                      const RenderPlan& plan) {
    for (const ChosenTechnique& chosen : plan.techniques) {
        if (!chosen.technique->mergeable())
            throw Error(ExitCode::usage, fmt::format("--resume: {}", chosen.technique->state));
    }
    if (!fs::exists(file)) {
        if (!command.quiet)
            fmt::print(stderr, "note: there is no {}: the render starts anew\n", file.string());
        return {};
    }
    FilmPart part = read_part(file);
    check_goes_on(part, scene, plan, file);
    if (!command.quiet)
        fmt::print(stderr, "note: going on from {} samples of {}\n", part.done.begin()->second,
                   file.string());
    return start_of(std::move(part));
}

void refuse_in_a_range(const RenderCommand& command) {
    const auto refuse = [](const char* flag, const char* instead) {
        throw Error(ExitCode::usage, fmt::format("{} is for one picture; {}", flag, instead));
    };
    if (command.shard) refuse("--shard", "share a frame range by --frames A-B instead");
    if (command.resume) refuse("--resume", "go on with --frames from the first frame that is missing");
    if (command.checkpoint_s) refuse("--checkpoint", "a frame range keeps each frame that is finished");
}

}  // namespace

Shard shard_of(const RenderCommand& command) {
    return command.shard ? parse_shard(*command.shard) : Shard{};
}

void check_part_flags(const RenderCommand& command, const std::vector<std::string>& outputs) {
    const auto refuse = [](const std::string& why) { throw Error(ExitCode::usage, why); };
    (void)shard_of(command);
    if (command.checkpoint_s && !(*command.checkpoint_s >= 0.0 && std::isfinite(*command.checkpoint_s)))
        refuse(fmt::format("--checkpoint: {} is not a number of seconds; 0 is none", *command.checkpoint_s));
    if (command.scene.frames) refuse_in_a_range(command);
    if (command.shard && command.error)
        refuse("--shard and --error: the error of the whole picture is not known before voxilux merge");
    if (std::ranges::any_of(outputs, is_exr)) return;
    if (command.shard) refuse("--shard: its part of the picture goes into an EXR; add -o FILE.exr");
    if (command.resume || command.checkpoint_s.value_or(0.0) > 0.0)
        refuse("--resume and --checkpoint: checkpoints lie beside an EXR; add -o FILE.exr");
}

std::optional<fs::path> checkpoint_file(const RenderCommand& command,
                                        const std::vector<std::string>& outputs) {
    const auto exr = std::ranges::find_if(outputs, is_exr);
    if (exr == outputs.end() || command.scene.frames) return std::nullopt;
    return fs::path(*exr + ".part");
}

void set_part_options(const RenderCommand& command, const std::vector<std::string>& outputs,
                      RenderOptions& options) {
    const auto file = checkpoint_file(command, outputs);
    if (!file) return;
    options.checkpoint_s = checkpoint_seconds(command);
    options.on_checkpoint = [&command, file = *file](const Scene& scene, RenderOutcome outcome) {
        save_checkpoint(command, file, scene, std::move(outcome));
    };
    options.keeps_film = command.shard.has_value() || options.checkpoint_s > 0.0;
    if (command.resume) {
        options.resume = [&command, file = *file](const Scene& scene, const RenderPlan& plan) {
            return resume_from(command, file, scene, plan);
        };
    } else if (fs::exists(*file) && !command.quiet) {
        fmt::print(stderr, "note: there is a checkpoint, {}; --resume goes on from it\n", file->string());
    }
}

FilmPart part_to_write(const RenderCommand& command, const Scene& scene, RenderOutcome outcome) {
    nlohmann::ordered_json report = report_of_picture(command, scene, outcome);
    const ExrOptions file = exr_options(command, scene, outcome.plan);
    return part_of(scene, std::move(outcome), std::move(report), file);
}

void leave_checkpoint(const RenderCommand& command, const std::vector<std::string>& outputs,
                      const Scene& scene, const RenderOutcome& outcome) {
    const auto file = checkpoint_file(command, outputs);
    if (file && checkpoint_seconds(command) > 0.0 && !is_finished(outcome))
        save_checkpoint(command, *file, scene, outcome);
}

void remove_checkpoint(const RenderCommand& command, const std::vector<std::string>& outputs,
                       const RenderOutcome& outcome) {
    const auto file = checkpoint_file(command, outputs);
    std::error_code ignored;
    if (file && is_finished(outcome)) fs::remove(*file, ignored);
}

}  // namespace voxilux
