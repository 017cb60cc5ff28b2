#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "estimators/error_curve.h"
#include "renderer/prepared_scene.h"
#include "vk/executor.h"

namespace voxilux {

struct SampleTime {
    double number = 1.0;  // of the sample in its render, from 1
    double seconds = 0.0;
};

// What the first samples of a render tell of the others.
struct ErrorPilot {
    ErrorLaw law;
    std::vector<ErrorPoint> points;
    std::vector<SampleTime> times;  // without the first sample, for which pipelines are made
    std::uint32_t samples = 0;      // in the points' film
    double film_s = 0.0;            // to read a film and estimate its error, once
    bool is_complete = true;        // false when it was stopped: it may know nothing
};

struct PilotJob {
    const PreparedScene& prepared;
    const Scene& scene;
    double error = 0.0;  // target
    bool is_cpu = true;
    std::function<bool()> stops;  // asked before each sample
};

// The numbers of samples at which a pilot looks at its film, and its end, are functions of the picture and of
// the errors that it finds, not of time: two runs decide alike. It ends with about 2 % of the samples that
// the target needs, or kPilotWork when that is more.
inline constexpr double kPilotShare = 0.02;
inline constexpr double kPilotWork = 1u << 20;  // pixels times samples: a second on two cores
inline constexpr std::uint32_t kMinPilotSamples = 8;
inline constexpr std::uint32_t kMaxPilotSamples = 256;

// Whether a pilot of so many samples doubles them. `needed`: samples that the target needs, as known now.
[[nodiscard]] bool doubles_pilot(std::uint32_t samples, double pixels, double needed);

// Takes samples of the whole picture that no picture is made of, on a device that holds the world. The film
// is left dirty. The samples of the plan must not depend on those before (Technique::keeps_state).
[[nodiscard]] ErrorPilot run_error_pilot(const PilotJob& job, Executor& executor);

}  // namespace voxilux
