#include "jobs/checkpoint.h"

#include <algorithm>
#include <cstdlib>
#include <new>
#include <utility>

#include "base/error.h"

namespace voxilux {
namespace {

namespace fs = std::filesystem;

bool is_finished(const RenderOutcome& outcome) {
    const StopReason stop = outcome.statistics.stop;
    return stop == StopReason::finished || stop == StopReason::error_target;
}

// A checkpoint that cannot be written must not stop the render. Samples that depend on earlier ones cannot be
// resumed.
void save_checkpoint(const Checkpoint& checkpoint, const Scene& scene,
                     const std::function<RenderOutcome()>& so_far) {
    try {
        RenderOutcome outcome = so_far();
        if (outcome.plan.any(&Technique::keeps_state)) return;
        FilmPart part = part_to_write(checkpoint.pictures, scene, std::move(outcome));
        const ExrOptions options = part.file;
        (void)write_exr(checkpoint.file, image_of(std::move(part)), options);
    } catch (const Error& error) {
        checkpoint.warn(fmt::format("no checkpoint: {}", error.what()));
    } catch (const std::bad_alloc&) {
        checkpoint.warn("no checkpoint: out of memory");
    }
}

void check_resumable(const FilmPart& part, const RenderPlan& plan, const nlohmann::ordered_json& render,
                     const fs::path& file) {
    const auto refuse = [&](const std::string& why) {
        throw Error(ExitCode::input_refused,
                    fmt::format("{}: cannot go on from it: {}; without --resume the render starts anew",
                                file.string(), why));
    };
    if (const auto other = difference(part.render, render)) refuse(*other);
    const std::uint32_t samples = part.samples.size();
    const bool is_ahead = part.rows_ahead > 0;
    if (part.samples != plan.part.prefix(samples) ||
        (is_ahead && part.sample_ahead != plan.part.sample(samples)))
        refuse(fmt::format("it has other samples than this render begins with, {}", part.samples.text()));
    if (samples + (is_ahead ? 1 : 0) > plan.samples())
        refuse(fmt::format("it has more than {} samples already", plan.samples()));
}

FilmStart resume_from(const Checkpoint& checkpoint, const RenderPlan& plan,
                      const nlohmann::ordered_json& render) {
    for (const ChosenTechnique& chosen : plan.techniques) {
        if (!chosen.technique->mergeable())
            throw Error(ExitCode::usage, fmt::format("--resume: {}", chosen.technique->state));
    }
    std::error_code ignored;
    if (!fs::exists(checkpoint.file, ignored)) {
        checkpoint.note(fmt::format("there is no {}: the render starts anew", checkpoint.file.string()));
        return {};
    }
    FilmPart part = read_part(checkpoint.file);
    check_resumable(part, plan, render, checkpoint.file);
    checkpoint.note(
        fmt::format("going on from {} samples of {}", part.samples.size(), checkpoint.file.string()));
    return start_of(std::move(part));
}

}  // namespace

fs::path checkpoint_file(const PictureFiles& pictures) {
    const auto exr = std::ranges::find_if(pictures.files, is_exr);
    return exr == pictures.files.end() ? fs::path() : fs::path(*exr + ".part");
}

void use_checkpoint(const Checkpoint& checkpoint, bool resumes, RenderOptions& options) {
    options.rehearse_end = [&](const Scene& scene, RenderOutcome strip) {
        rehearse_output(checkpoint, scene, std::move(strip));
    };
    std::error_code ignored;
    if (checkpoint.file.empty()) return;
    options.checkpoint_s = checkpoint.every_s;
    options.on_checkpoint = [&](const Scene& scene, const std::function<RenderOutcome()>& so_far) {
        save_checkpoint(checkpoint, scene, so_far);
    };
    options.keeps_film = checkpoint.pictures.is_part || checkpoint.every_s > 0.0;
    if (resumes) {
        options.resume = [&](const Scene& scene, const RenderPlan& plan, const DeviceInfo& device) {
            return resume_from(checkpoint, plan, render_key(scene, plan, device));
        };
    } else if (fs::exists(checkpoint.file, ignored)) {
        checkpoint.note(
            fmt::format("there is a checkpoint, {}; --resume goes on from it", checkpoint.file.string()));
    }
}

void leave_checkpoint(const Checkpoint& checkpoint, const Scene& scene, const RenderOutcome& outcome) {
    if (!checkpoint.file.empty() && checkpoint.every_s > 0.0 && !is_finished(outcome))
        save_checkpoint(checkpoint, scene, [&] { return outcome; });
}

void remove_checkpoint(const Checkpoint& checkpoint, const RenderOutcome& outcome) {
    std::error_code ignored;
    if (!checkpoint.file.empty() && is_finished(outcome)) fs::remove(checkpoint.file, ignored);
}

void rehearse_output(const Checkpoint& checkpoint, const Scene& scene, RenderOutcome strip) try {
    std::string folder = (fs::temp_directory_path() / "voxilux-XXXXXX").string();
    if (::mkdtemp(folder.data()) == nullptr) return;
    strip.statistics.stop = StopReason::time_limit;
    Checkpoint copy = checkpoint;
    for (std::size_t i = 0; i < copy.pictures.files.size(); ++i) {
        std::string& file = copy.pictures.files[i];
        file = fs::path(folder) / fmt::format("{}{}", i, fs::path(file).extension().string());
    }
    if (!copy.file.empty()) copy.file = checkpoint_file(copy.pictures);
    try {
        leave_checkpoint(copy, scene, strip);
        write_pictures(copy.pictures, scene, strip);
    } catch (const Error&) {
    }
    fs::remove_all(folder);
} catch (const fs::filesystem_error&) {
}

}  // namespace voxilux
