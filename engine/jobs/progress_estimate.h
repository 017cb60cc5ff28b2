#pragma once

#include <optional>

namespace voxilux {

// Where a frame stands. Samples may be broken numbers.
struct FrameProgress {
    double start = 0.0;       // samples that the film began with
    double samples = 0.0;     // now
    double end = 0.0;         // expected, as planned
    double end_high = 0.0;    // that it may take
    double sampling_s = 0.0;  // since the first of them
    double recent_s = 0.0;    // per sample, of the last ones; 0: unknown
    double end_s = 0.0;       // from the last sample to the end
    std::optional<double> limit_left_s;
};

struct RemainingTime {
    double done = 0.0;  // [0,1]
    double low_s = 0.0, expected_s = 0.0, high_s = 0.0;
};

// How long a frame will take from now on, if the pace stays between that of all samples so far and that of
// the last ones; never longer than the time limit.
[[nodiscard]] RemainingTime estimate_remaining(const FrameProgress& stand);

}  // namespace voxilux
