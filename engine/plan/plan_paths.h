#pragma once

#include <cstdint>

#include "plan/device_limits.h"

namespace voxilux {

// How paths run. All zero when none do.
struct PathPlan {
    std::uint32_t per_lane = 0;  // paths that an invocation traces, one after the other
    std::uint32_t rounds = 0;    // dispatches of a sample: in each an invocation goes on with its paths

    bool operator==(const PathPlan&) const = default;
    [[nodiscard]] bool runs() const { return rounds != 0; }
};

// What the plan of paths depends on.
struct PathNeeds {
    bool aims_at_sky = false;    // at an image of it
    double max_albedo = 0.0;     // of a diffuse material
    double sphere_visits = 0.0;  // of a ray that looks for spheres
    bool has_voxels = false;
};

[[nodiscard]] PathPlan plan_paths(const PathNeeds& needs, const DeviceLimits& limits);

}  // namespace voxilux
