#include "plan/plan_paths.h"

#include <algorithm>
#include <cmath>

#include "shared/limits.h"

namespace voxilux {
namespace {

// Paths of one invocation on a CPU: enough that it does not matter when the last of them ends, and few enough
// that a small image has work for all threads.
constexpr double kPathsPerLane = 16.0;
constexpr double kRaysOfVertex = 3.0;   // to the sun, to an emitter, onwards
constexpr double kVisitsOfPaths = 2.0;  // to find a sphere, and the glass around the point on it
constexpr double kTurnsOfMarch = 16.0;  // of all loops for a ray, where eight lanes wait for the slowest
// Least fraction of its light that a surface is taken to absorb. Whiter rooms have openings; where they have
// none, no path ends.
constexpr double kLeastLoss = 0.002;
// The probability of a path that is longer than planned for.
constexpr double kRarePath = 1e-9;
// Longer paths are cut and counted: in a closed room of albedo 1 no path ever ends.
constexpr double kMaxRounds = 16.0;

}  // namespace

PathPlan plan_paths(const PathNeeds& needs, const DeviceLimits& limits) {
    const double spheres = kVisitsOfPaths * needs.sphere_visits;
    const double rays = kRaysOfVertex + (needs.aims_at_sky ? 1.0 : 0.0);
    const double turns = rays * (1.0 + spheres + (needs.has_voxels ? kTurnsOfMarch : 0.0));  // of a surface
    const double albedo = std::min(needs.max_albedo, 1.0);
    const double mean = turns / std::max(1.0 - albedo, kLeastLoss);
    const double most = gpu::kMaxPathSurfaces;
    const double longest =
        albedo < 1.0 ? std::min(most, std::log(kRarePath) / std::log(std::max(albedo, kRarePath))) : most;
    const double budget = gpu::kRoundTurns;
    const double per_lane =
        limits.is_cpu ? std::clamp(0.5 * budget * kMaxRounds / mean, 1.0, kPathsPerLane) : 1.0;
    const double rounds = std::ceil((per_lane * mean + turns * longest) / budget);
    return {.per_lane = static_cast<std::uint32_t>(per_lane),
            .rounds = static_cast<std::uint32_t>(std::clamp(rounds, 1.0, kMaxRounds))};
}

}  // namespace voxilux
