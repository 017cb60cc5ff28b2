#pragma once

// Rays that have made marches fail before, generated from a seed, and small worlds for them.

#include <random>
#include <string>
#include <vector>

#include "shared/gpu_types.h"
#include "shared/limits.h"
#include "world/voxel_world.h"

namespace voxilux::test {

struct RayFamily {
    std::string name;
    std::vector<gpu::Ray> rays;
};

// Families of `count` rays each that start in cells of a world of `size` cells: random, axis-parallel with
// both signs of zero, in face planes, along edges, through lattice corners, near-axial, with denormal
// components, and not of unit length.
[[nodiscard]] std::vector<RayFamily> ray_families(glm::ivec3 size, int count, std::uint32_t seed);

struct NamedWorld {
    std::string name;
    VoxelWorld world;
};

// Empty, full, one voxel, checkerboard, one-voxel diagonal wall, shell, 1 x 1 x N rod, random at four
// densities.
[[nodiscard]] std::vector<NamedWorld> small_worlds(std::uint32_t seed);

}  // namespace voxilux::test
