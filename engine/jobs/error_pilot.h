#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "estimators/error_curve.h"
#include "renderer/prepared_scene.h"
#include "vk/executor.h"

namespace voxilux {

struct SampleTime {
    double number = 1.0;  // index of the sample in its render, from 1
    double seconds = 0.0;
};

// What the first samples of a render predict of the others.
struct ErrorPilot {
    ErrorLaw law;
    std::vector<ErrorPoint> points;
    std::vector<SampleTime> times;  // without the first sample, which compiles pipelines
    std::uint32_t samples = 0;      // in the film of the points
    double film_s = 0.0;            // to read a film and estimate its error, once
    bool is_complete = true;        // false when it was stopped early: there may be no points
};

struct PilotJob {
    const PreparedScene& prepared;
    const Scene& scene;
    double error = 0.0;  // target
    bool is_cpu = true;
    std::function<bool()> stops;  // asked before each sample
};

// The sample counts at which a pilot estimates the error of its film, and its end, depend on the image and on
// the errors found, not on time: two runs decide alike. It ends with about 2 % of the samples that the target
// needs, or kPilotWork when that is more.
inline constexpr double kPilotShare = 0.02;
inline constexpr double kPilotWork = 1u << 20;  // pixels times samples: about a second on two cores
inline constexpr std::uint32_t kMinPilotSamples = 8;
inline constexpr std::uint32_t kMaxPilotSamples = 256;

// Whether a pilot with this many samples doubles them. `needed`: samples that the target needs, as known now.
[[nodiscard]] bool doubles_pilot(std::uint32_t samples, double pixels, double needed);

// Takes samples of the whole image that are not part of the result, on a device that holds the world. The
// film is not cleared afterwards. The samples of the plan must not depend on earlier ones
// (Technique::keeps_state).
[[nodiscard]] ErrorPilot run_error_pilot(const PilotJob& job, Executor& executor);

}  // namespace voxilux
