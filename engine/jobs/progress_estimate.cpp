#include "jobs/progress_estimate.h"

#include <algorithm>

namespace voxilux {
namespace {

constexpr double kPaceMargin = 0.05;  // relative, on both sides

}  // namespace

RemainingTime estimate_remaining(const FrameProgress& stand) {
    RemainingTime rest;
    const double taken = stand.samples - stand.start;
    if (taken > 0.0) {
        const double pace = stand.sampling_s / taken;
        const double recent = stand.recent_s > 0.0 ? stand.recent_s : pace;
        const double left = std::max(stand.end - stand.samples, 0.0);
        const double left_high = std::max(stand.end_high - stand.samples, left);
        rest.low_s = left * std::min(pace, recent) * (1.0 - kPaceMargin) + stand.end_s;
        rest.expected_s = left * pace + stand.end_s;
        rest.high_s = left_high * std::max(pace, recent) * (1.0 + kPaceMargin) + stand.end_s;
    }
    if (stand.end > 0.0) rest.done = std::min(stand.samples / stand.end, 1.0);
    if (!stand.limit_left_s) return rest;
    const double max_s = std::max(*stand.limit_left_s, 0.0);
    if (rest.expected_s > max_s && stand.sampling_s + max_s > 0.0)
        rest.done = std::max(rest.done, stand.sampling_s / (stand.sampling_s + max_s));
    for (double* seconds : {&rest.low_s, &rest.expected_s, &rest.high_s})
        *seconds = std::min(*seconds, max_s);
    return rest;
}

}  // namespace voxilux
