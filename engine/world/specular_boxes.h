#pragma once

#include <vector>

#include "scene/scene.h"
#include "world/box_clusters.h"
#include "world/voxel_world.h"

namespace voxilux {

// Boxes around all that bends or mirrors light: spheres and voxels, a few hundred boxes at most.
[[nodiscard]] std::vector<RoundedBox> find_specular(const Scene& scene, const VoxelWorld* world,
                                                    glm::ivec3 origin);

}  // namespace voxilux
