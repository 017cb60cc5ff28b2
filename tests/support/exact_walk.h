#pragma once

// The march's contract in exact integers, for rays whose numbers are halves: crossings are sorted by their
// exact time, then by axis. Knows nothing of the march's floats.

#include "support/plain_walk.h"

namespace voxilux::test {

struct ExactHit {
    glm::ivec3 cell{0};
    gpu::uint face = gpu::kFaceMiss;
};

// Direction components must be integers below 2^10 (of zeros, either sign), fractions along axes that move
// must be multiples of 1/2, and t_max must be irrelevant.
[[nodiscard]] ExactHit exact_walk(const VoxelWorld& world, const gpu::Ray& ray, AxisOrder order = kTieRule);

}  // namespace voxilux::test
