#pragma once

#include <cstdint>
#include <optional>

#include "world/voxel_world.h"

namespace voxilux {

// The first voxel on a ray.
struct PickedVoxel {
    glm::ivec3 cell{0};    // of the scene
    glm::ivec3 normal{0};  // of the face that was met; 0: the ray begins inside
    std::uint32_t material = 0;
    double distance = 0.0;  // voxels along `direction`, if that is a unit vector
};

// Walks by cells and, where a chunk is empty, by the whole chunk (J. Amanatides and A. Woo 1987, "A Fast
// Voxel Traversal Algorithm for Ray Tracing"), in double precision. `start` is in scene space. Spheres are
// not looked at.
[[nodiscard]] std::optional<PickedVoxel> pick_voxel(const VoxelWorld& world, glm::dvec3 start,
                                                    glm::dvec3 direction);

}  // namespace voxilux
