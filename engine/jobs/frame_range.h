#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>

#include "jobs/frame_list.h"
#include "jobs/render_session.h"

namespace voxilux {

// The frames of a range and the time that they may take together.
struct FrameRangeJob {
    FrameList frames;
    std::optional<double> time_limit_s;
    std::chrono::steady_clock::time_point started;
};

// The time limit of the frame at `index`: remaining frames get equal parts of the remaining time.
[[nodiscard]] std::optional<double> time_limit_of_frame(const FrameRangeJob& job, std::int64_t index);

// Whether there is time to render the frame at `index`, when the one before took `before_s` for its
// `before_samples`: one sample has to fit. The first frame is always rendered.
[[nodiscard]] bool fits_in_time(const FrameRangeJob& job, std::int64_t index, double before_s,
                                std::uint32_t before_samples);

// Calls `show` with the progress of the frame at `index` converted to that of the whole range. Empty if
// `show` is.
[[nodiscard]] std::function<void(const Progress&)> progress_of_range(
    const FrameRangeJob& job, std::int64_t index, const std::function<void(const Progress&)>& show);

}  // namespace voxilux
