#pragma once

// Checks marched rays against a plain walk over the voxels that shares no code with the march.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "shared/gpu_types.h"
#include "world/voxel_world.h"

namespace voxilux {

// What a ray must hit: the cell, and the face through which the ray enters it. The cell is meaningless when
// the face is kFaceMiss.
struct WalkedHit {
    glm::ivec3 cell{0};
    gpu::uint face = gpu::kFaceMiss;
    float t = 0.0f;           // where the ray enters the cell
    std::uint64_t cells = 0;  // visited
};

// The first voxel of a ray that starts inside the world, one cell at a time by the march's contract: crossing
// j of axis a comes at float t (j + flip + offset) / |direction|, x before y before z at equal t (Amanatides
// & Woo 1987, with absolute t).
[[nodiscard]] WalkedHit walk_ray(const VoxelWorld& world, const gpu::Ray& ray);

// Rays of a list with their expected hits.
struct Verdicts {
    std::vector<std::size_t> rays;  // indices in the list
    std::vector<WalkedHit> hits;    // of these rays
};

// Walks rays spread evenly over the list until about `max_cells` cells have been visited: at least one ray.
[[nodiscard]] Verdicts check_rays(const VoxelWorld& world, std::span<const gpu::Ray> rays,
                                  std::uint64_t max_cells);

// How many of the checked rays hit something else. `hits` has one entry per ray of the list.
[[nodiscard]] std::uint64_t count_mismatches(const Verdicts& verdicts, std::span<const gpu::BenchHit> hits);

}  // namespace voxilux
