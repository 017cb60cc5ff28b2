#include "render/render_frames.h"

#include <algorithm>
#include <set>

#include "base/error.h"
#include "frame/footprint.h"
#include "jobs/report.h"
#include "output_files.h"
#include "render/render_output.h"

namespace voxilux {
namespace {

// Of a frame to come, over the mean of those so far.
constexpr double kLeastPace = 0.8;
constexpr double kMostPace = 1.25;

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::optional<double> share_of_time(const RenderJob& job, std::int64_t index) {
    if (!job.options.time_limit_s) return std::nullopt;
    const double left = *job.options.time_limit_s - seconds_since(job.options.started);
    return std::max(left, 0.0) / static_cast<double>(job.frames.count() - index);
}

// The progress of a frame as that of the whole range.
std::function<void(const Progress&)> progress_of_range(const RenderJob& job, std::int64_t index) {
    const auto show = job.progress.callback();
    if (!show) return {};
    const auto count = static_cast<double>(job.frames.count());
    return [=, started = job.options.started](Progress progress) {
        progress.frame = static_cast<std::uint32_t>(index + 1);
        progress.frames = static_cast<std::uint32_t>(count);
        const double done = progress.done;
        progress.done = (static_cast<double>(index) + done) / count;
        progress.elapsed_s = seconds_since(started);
        const double frames_left = count - static_cast<double>(index + 1);
        const double frame_s = progress.elapsed_s / (static_cast<double>(index) + done);
        progress.remaining_s += frames_left * frame_s;
        progress.remaining_low_s += frames_left * frame_s * kLeastPace;
        progress.remaining_high_s += frames_left * frame_s * kMostPace;
        show(progress);
    };
}

void print_frame(const RenderCommand& command, std::int64_t frame, const std::vector<std::string>& files,
                 const RenderStatistics& statistics) {
    if (command.quiet || command.json == "-") return;
    const std::string error =
        statistics.error.is_known() ? fmt::format("{:.3g}", statistics.error.estimate) : "unknown";
    fmt::print("frame     {:<6} {:.2f} s, {} samples, error {}  {}\n", frame, statistics.wall_s,
               statistics.samples, error, fmt::join(files, " "));
    std::fflush(stdout);  // whoever waits for a frame reads it now
}

void print_end(const RenderCommand& command, const SequenceReport& report, std::size_t missed) {
    if (!command.quiet && missed != 0)
        fmt::print(stderr, "warning: {} of {} frames stopped with an error over the {} asked for\n", missed,
                   report.frames.size(), *command.error);
    if (!command.quiet && command.json != "-") fmt::print("{}", describe(report.total));
}

// Says how to go on from an interrupted frame.
void print_interruption(const FrameList& frames, std::int64_t index) {
    fmt::print(stderr,
               "voxilux: interrupted in frame {}; {} of {} frames are written; go on with --frames {}-{}{}\n",
               frames.at(index), index, frames.count(), frames.at(index), frames.last,
               frames.step == 1 ? "" : fmt::format("x{}", frames.step));
}

// What the frames so far left behind.
struct Rendered {
    SequenceReport report;
    std::set<std::string> said;
    std::size_t missed = 0;  // frames over the error asked for
    ExitCode code = ExitCode::done;
};

// Renders and writes one frame; false when it was interrupted.
bool render_frame(const RenderCommand& command, RenderSession& session, const RenderJob& job,
                  std::int64_t index, Rendered& done) try {
    const std::int64_t frame = job.frames.at(index);
    RenderOutcome outcome = session.render(frame, share_of_time(job, index), progress_of_range(job, index));
    job.progress.finish();
    if (outcome.statistics.stop == StopReason::interrupted) return false;
    const std::vector<std::string> files = files_of_frame(job.outputs, job.frames, frame);
    write_pictures(command, files, session.scene(), outcome);
    if (index == 0 && command.verbose && !command.quiet && command.json != "-")
        fmt::print("{}", describe(outcome.plan));
    print_validation(outcome);
    print_warnings(command, outcome, done.said);
    print_frame(command, frame, files, outcome.statistics);
    add_frame(done.report, frame, files, outcome);
    if (missed_error(command, outcome)) ++done.missed;
    if (exit_code(command, outcome) == ExitCode::time_limit) done.code = ExitCode::time_limit;
    return true;
} catch (const Error& error) {
    if (index == 0) throw;
    throw Error(error.code(), fmt::format("frame {}: {}; {} of {} frames are written", job.frames.at(index),
                                          error.what(), index, job.frames.count()));
}

}  // namespace

std::vector<std::string> files_of_frame(const std::vector<std::string>& outputs, const FrameList& frames,
                                        std::int64_t frame) {
    if (!frames.is_sequence) return outputs;
    std::vector<std::string> files;
    for (const std::string& output : outputs)
        files.push_back(numbered(output, frame, frames.last).string());
    return files;
}

int render_frames(const RenderCommand& command, RenderSession& session, const RenderJob& job) {
    Rendered done;
    std::int64_t index = 0;
    while (index < job.frames.count() && render_frame(command, session, job, index, done))
        ++index;
    const bool is_interrupted = index < job.frames.count();
    if (index == 0) throw Error(ExitCode::interrupted, "interrupted in the first frame; nothing was written");
    SequenceReport& report = done.report;
    report.total.statistics.wall_s = seconds_since(job.options.started);
    print_faults(report.total);
    print_end(command, report, done.missed);
    if (is_interrupted) print_interruption(job.frames, index);
    write_json(command.json, sequence_json(session.scene(), job.scene_hash, report));
    return static_cast<int>(is_interrupted ? ExitCode::interrupted : done.code);
}

}  // namespace voxilux
