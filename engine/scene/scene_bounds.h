#pragma once

#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "scene/scene.h"

namespace voxilux {

// No voxel or sphere may reach further from the origin on any axis. Twice it still fits an int.
inline constexpr int kMaxCoordinate = 1 << 30;

// The smallest box around the voxels of each model, in its own space; what it has as boxes does not count.
[[nodiscard]] std::vector<Box> voxel_boxes(std::span<const VoxelModel> models);

// The smallest box around the filled cells of all instances, empty when there are none.
// Throws Error(input_refused) when one lies beyond kMaxCoordinate.
[[nodiscard]] Box voxel_bounds(const Scene& scene);
[[nodiscard]] Box voxel_bounds(std::span<const VoxelModel> models, std::span<const Instance> instances);

// The box of all spheres, rounded outwards to whole cells. Throws as voxel_bounds does.
[[nodiscard]] Box sphere_bounds(std::span<const Sphere> spheres);

// As voxel_bounds, with the spheres (rounded outwards to whole cells).
[[nodiscard]] Box scene_bounds(const Scene& scene);

}  // namespace voxilux
