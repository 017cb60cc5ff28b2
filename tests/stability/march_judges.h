#pragma once

// What the hard cases of the march share: worlds, rays, and the judges of a march on the device.

#include <string>
#include <vector>

#include "support/march_probe.h"
#include "support/ray_families.h"

namespace voxilux::test {

inline constexpr std::uint32_t kMarchSeed = 20263;
// Voxels. Rounding moves a crossing by at most 2^-23 of the path, 60 voxels here; the margin is far above it.
inline constexpr double kMarchMargin = 1e-3;

// One of small_worlds().
[[nodiscard]] const VoxelWorld& world_named(const std::string& name);

// One of ray_families(), and all of them together.
[[nodiscard]] std::vector<gpu::Ray> family_named(const std::string& name, glm::ivec3 size, int count);
[[nodiscard]] std::vector<gpu::Ray> all_families(glm::ivec3 size, int count);

// March on the device and expect the cells of the walk in exact integers (exact_walk.h).
void expect_exact_walk(const VoxelWorld& world, const std::vector<gpu::Ray>& rays);

// March on the device and expect cell, face and time of the plain walk, and the step bound.
void expect_plain_walk(const VoxelWorld& world, const std::vector<gpu::Ray>& rays);

// March on the device and expect what boxes in double precision allow.
void expect_boxes(const VoxelWorld& world, const std::vector<gpu::Ray>& rays);

}  // namespace voxilux::test
