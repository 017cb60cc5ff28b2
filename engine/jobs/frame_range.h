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

// The time limit of the frame at `index`: each of those to come gets an equal part of the time that is left.
[[nodiscard]] std::optional<double> time_limit_of_frame(const FrameRangeJob& job, std::int64_t index);

// Whether the frame at `index` can still be rendered in time, when the one before took `before_s` for its
// `before_samples`: one sample has to fit. The first frame always is.
[[nodiscard]] bool fits_in_time(const FrameRangeJob& job, std::int64_t index, double before_s,
                                std::uint32_t before_samples);

// Calls `show` with the progress of the frame at `index` as that of the whole range. Empty where `show` is.
[[nodiscard]] std::function<void(const Progress&)> progress_of_range(
    const FrameRangeJob& job, std::int64_t index, const std::function<void(const Progress&)>& show);

}  // namespace voxilux
