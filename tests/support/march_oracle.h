#pragma once

// A truth for the march that knows nothing of steps: it tests every solid cell as a box in double precision.

#include <optional>
#include <vector>

#include "support/plain_walk.h"

namespace voxilux::test {

// Bounds of a right answer. Boxes shrunk by `margin` voxels must stop a ray, boxes grown by it may.
struct OracleBounds {
    std::optional<double> must_by;  // entry of the first shrunk solid box; the ray is stopped by then
    std::vector<std::pair<glm::ivec3, double>>
        may;  // grown solid boxes that the ray meets, with their entry time
};

[[nodiscard]] OracleBounds oracle_bounds(const std::vector<glm::ivec3>& solids, const gpu::Ray& ray,
                                         double margin);

// Empty when the hit agrees with the bounds, else what is wrong. Times may differ by `margin` / |direction|.
[[nodiscard]] std::string disagreement(const OracleBounds& bounds, const gpu::Ray& ray,
                                       const gpu::MarchHit& hit, double margin);

// Local cells of every filled voxel, chunk by chunk.
[[nodiscard]] std::vector<glm::ivec3> solid_cells(const VoxelWorld& world);

}  // namespace voxilux::test
