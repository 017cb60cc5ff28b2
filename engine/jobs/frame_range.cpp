#include "jobs/frame_range.h"

#include <algorithm>

#include "base/clock.h"

namespace voxilux {
namespace {

// Time of a future frame divided by the mean of those so far.
constexpr double kFastestFrame = 0.8;
constexpr double kSlowestFrame = 1.25;

}  // namespace

std::optional<double> time_limit_of_frame(const FrameRangeJob& job, std::int64_t index) {
    if (!job.time_limit_s) return std::nullopt;
    const double left = *job.time_limit_s - seconds_since(job.started);
    return std::max(left, 0.0) / static_cast<double>(job.frames.count() - index);
}

bool fits_in_time(const FrameRangeJob& job, std::int64_t index, double before_s,
                  std::uint32_t before_samples) {
    if (!job.time_limit_s || index == 0) return true;
    return seconds_since(job.started) + before_s / std::max(before_samples, 1u) <= *job.time_limit_s;
}

std::function<void(const Progress&)> progress_of_range(const FrameRangeJob& job, std::int64_t index,
                                                       const std::function<void(const Progress&)>& show) {
    if (!show) return {};
    const auto count = static_cast<double>(job.frames.count());
    return [=, started = job.started](Progress progress) {
        progress.frame = static_cast<std::uint32_t>(index + 1);
        progress.frames = static_cast<std::uint32_t>(count);
        const double frames_done = static_cast<double>(index) + progress.done;
        progress.done = frames_done / count;
        progress.elapsed_s = seconds_since(started);
        const double frames_left = count - static_cast<double>(index + 1);
        const double frame_s = progress.elapsed_s / frames_done;
        progress.remaining_s += frames_left * frame_s;
        progress.remaining_low_s += frames_left * frame_s * kFastestFrame;
        progress.remaining_high_s += frames_left * frame_s * kSlowestFrame;
        show(progress);
    };
}

}  // namespace voxilux
