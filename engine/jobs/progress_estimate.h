#pragma once

#include <optional>

namespace voxilux {

// The state of a frame. Sample counts may be fractional.
struct FrameProgress {
    double start = 0.0;       // samples that the film began with
    double samples = 0.0;     // now
    double end = 0.0;         // expected, as planned
    double end_high = 0.0;    // upper bound
    double sampling_s = 0.0;  // since the first sample
    double recent_s = 0.0;    // per sample, averaged over the last ones; 0: unknown
    double end_s = 0.0;       // from the last sample to the end of the render
    std::optional<double> limit_left_s;
};

struct RemainingTime {
    double done = 0.0;  // [0,1]
    double low_s = 0.0, expected_s = 0.0, high_s = 0.0;
};

// How long a frame will take from now on, if its speed stays between the mean so far and the recent mean;
// never longer than the time limit.
[[nodiscard]] RemainingTime estimate_remaining(const FrameProgress& stand);

}  // namespace voxilux
