#pragma once

// What the hard cases of the march share: worlds, rays, the march on the device through every structure, and
// its checkers.

#include <string>
#include <vector>

#include "support/march_probe.h"
#include "support/plain_walk.h"
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

// The world in every structure.
[[nodiscard]] std::vector<MarchWorld> all_structures(const VoxelWorld& world);

// What is wrong when the rays march through these structures on the device: two results that differ in a bit,
// more steps than the world has planes, the step limit reached. Empty when nothing is; `agreed` then holds
// the common hits, with 0 steps and misses without a cell.
[[nodiscard]] std::string march_differences(const std::vector<MarchWorld>& structures,
                                            const std::vector<gpu::Ray>& rays,
                                            std::vector<gpu::MarchProbe>& agreed);

// The hits of the rays, which must not depend on the structure; fails the test when march_differences are
// found.
[[nodiscard]] std::vector<gpu::MarchProbe> march_everywhere(const std::vector<MarchWorld>& structures,
                                                            const std::vector<gpu::Ray>& rays);
[[nodiscard]] std::vector<gpu::MarchProbe> march_everywhere(const VoxelWorld& world,
                                                            const std::vector<gpu::Ray>& rays);

// Marches through every structure and expects the cells of the walk in exact integers (exact_walk.h).
void expect_exact_walk(const VoxelWorld& world, const std::vector<gpu::Ray>& rays);

// Marches through every structure and expects cell, face, material, planes and time of the plain walk.
void expect_plain_walk(const VoxelWorld& world, const std::vector<gpu::Ray>& rays);

// Marches through every structure and expects an answer that the walk in real numbers allows
// (interval_walk.h).
void expect_interval_walk(const VoxelWorld& world, const std::vector<gpu::Ray>& rays);

// Marches through every structure and expects what boxes in double precision allow.
void expect_boxes(const VoxelWorld& world, const std::vector<gpu::Ray>& rays);

// Where a march differs from the plain walk, in words; empty where it does not.
[[nodiscard]] std::string difference(const gpu::MarchHit& got, const gpu::MarchHit& want);

}  // namespace voxilux::test
