#pragma once

#include <vector>

#include "shared/gpu_types.h"
#include "world/voxel_world.h"

namespace voxilux {

// A face of a voxel whose neighbour there is empty.
struct ExposedFace {
    glm::ivec3 cell{0};  // of the voxel, local to the world
    gpu::uint face = 0;  // -x +x -y +y -z +z
};

[[nodiscard]] std::vector<ExposedFace> exposed_faces(const VoxelWorld& world);

// The corners of a face in order around it, local to the world.
[[nodiscard]] std::array<glm::vec3, 4> corners_of(const ExposedFace& face);

}  // namespace voxilux
