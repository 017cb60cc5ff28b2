#include <set>

#include "base/clock.h"
#include "base/error.h"
#include "base/print.h"
#include "frame/footprint.h"
#include "jobs/report.h"
#include "render/print_render.h"
#include "render/render_job.h"

namespace voxilux {
namespace {

void print_frame(const RenderCommand& command, std::int64_t frame, const std::vector<std::string>& files,
                 const RenderStatistics& statistics) {
    if (!command.report.prints()) return;
    const std::string error =
        statistics.error.is_known() ? fmt::format("{:.3g}", statistics.error.estimate) : "unknown";
    print_result("frame     {:<6} {:.2f} s, {} samples, error {}  {}\n", frame, statistics.wall_s,
                 statistics.samples, error, fmt::join(files, " "));
    std::fflush(stdout);  // whoever waits for a frame reads it now
}

void print_end(const RenderCommand& command, const SequenceReport& report, std::size_t missed) {
    if (!command.report.quiet && missed != 0)
        print_message("warning: {} of {} frames stopped with an error over the {} asked for\n", missed,
                      report.frames.size(), target_text(command));
    if (command.report.prints()) print_result("{}", describe(report.total));
}

// Says how to go on from the first frame that is not written.
void print_rest(const FrameList& frames, std::int64_t index, const char* what_happened) {
    print_message("voxilux: {} frame {}; {} of {} frames are written; go on with --frames {}-{}{}\n",
                  what_happened, frames.at(index), index, frames.count(), frames.at(index), frames.last,
                  frames.step == 1 ? "" : fmt::format("x{}", frames.step));
}

// The results of the frames so far.
struct Rendered {
    SequenceReport report;
    std::set<std::string> said;
    std::size_t missed = 0;  // frames over the error asked for
    RenderStatistics last;   // of the frame that was rendered last
    ExitCode code = ExitCode::done;
};

// Renders and writes one frame; false when it was interrupted.
bool render_frame(const RenderCommand& command, RenderSession& session, const RenderJob& job,
                  std::int64_t index, Rendered& done) try {
    const std::int64_t frame = job.range.frames.at(index);
    RenderOutcome outcome = session.render(frame, time_limit_of_frame(job.range, index),
                                           progress_of_range(job.range, index, job.progress.callback()));
    job.progress.finish();
    if (outcome.statistics.stop == StopReason::interrupted) return false;
    PictureFiles pictures = job.checkpoint.pictures;
    pictures.files = files_of_frame(pictures.files, job.range.frames, frame);
    const std::vector<std::string>& files = pictures.files;
    write_pictures(pictures, session.scene(), outcome);
    if (index == 0 && command.verbose && command.report.prints()) print_result("{}", describe(outcome.plan));
    print_validation(outcome);
    print_warnings(command, outcome, done.said);
    print_frame(command, frame, files, outcome.statistics);
    add_frame(done.report, frame, files, outcome);
    done.last = outcome.statistics;
    if (missed_error(command, outcome)) ++done.missed;
    if (exit_code(command, outcome) == ExitCode::time_limit) done.code = ExitCode::time_limit;
    return true;
} catch (const Error& error) {
    if (index == 0) throw;
    throw Error(error.code(),
                fmt::format("frame {}: {}; {} of {} frames are written", job.range.frames.at(index),
                            error.what(), index, job.range.frames.count()));
}

}  // namespace

RenderedFrames render_frames(const RenderCommand& command, RenderSession& session, const RenderJob& job) {
    Rendered done;
    std::int64_t index = 0;
    const auto has_time = [&] { return fits_in_time(job.range, index, done.last.wall_s, done.last.samples); };
    bool is_interrupted = false;
    while (!is_interrupted && index < job.range.frames.count() && has_time()) {
        is_interrupted = !render_frame(command, session, job, index, done);
        if (!is_interrupted) ++index;
    }
    const bool has_rest = index < job.range.frames.count();
    if (index == 0) throw Error(ExitCode::interrupted, "interrupted in the first frame; nothing was written");
    SequenceReport& report = done.report;
    report.total.statistics.wall_s = seconds_since(job.range.started);
    print_faults(report.total);
    print_end(command, report, done.missed);
    if (has_rest) print_rest(job.range.frames, index, is_interrupted ? "interrupted in" : "no time left for");
    const ExitCode code = has_rest ? ExitCode::time_limit : done.code;
    return {.code = is_interrupted ? ExitCode::interrupted : code,
            .count = index,
            .report = sequence_json(session.scene(), job.scene_hash, report)};
}

}  // namespace voxilux
