#pragma once

// The march's contract in real numbers: the walk in double precision, with a bound on the errors of the
// march's floats. Where the order of two crossings is certain there is one way on; where it is not, both are
// followed. Shares no code with the march.

#include <string>
#include <vector>

#include "world/voxel_world.h"
#include "world/world_view.h"

namespace voxilux::test {

struct PossibleHit {
    glm::ivec3 cell{0};
    gpu::uint face = gpu::kFaceMiss;
    double t = 0.0;  // 0 on a miss
};

// Every answer that the march's floats may give; most rays have one. Exact ties that floats keep (both times
// 0, or speeds in a ratio of a power of two) are crossed x before y before z. The ray must be sound and start
// inside the world.
[[nodiscard]] std::vector<PossibleHit> interval_walk(const VoxelWorld& world, const gpu::Ray& ray);

// Empty when the hit is one of those and its time is within four units in the last place; else what is wrong.
[[nodiscard]] std::string disagreement(const std::vector<PossibleHit>& possible, const gpu::MarchHit& hit);

}  // namespace voxilux::test
