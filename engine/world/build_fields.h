#pragma once

#include "world/march_world.h"

namespace voxilux {

// Fills the arrays of `built`, whose traversal (one with boxes) and size are set, as world_cell.h says,
// except for the boxes that leave their parent: those distances are 0.
void build_skeleton(const VoxelWorld& world, MarchWorld& built);

// log2 of the cell edges, in voxels, of the levels whose boxes leave their parent, in the order they must
// grow in.
[[nodiscard]] std::vector<int> far_levels(Traversal traversal);

// The words of the level of cells of edge 2^log2 voxels.
[[nodiscard]] std::vector<std::uint32_t>& level_cells(MarchWorld& built, int log2);
[[nodiscard]] const std::vector<std::uint32_t>& level_cells(const MarchWorld& built, int log2);

// Where its blocks of 64 cells are; empty for roots.
[[nodiscard]] const std::vector<std::uint32_t>& level_homes(const MarchWorld& built, int log2);

// What growing a skeleton on the device takes: bytes of scratch, and steps.
struct GrowthNeeds {
    std::uint64_t home_bytes = 0;
    std::uint64_t grown_bytes = 0;
    std::uint64_t steps = 0;

    bool operator==(const GrowthNeeds&) const = default;
};
[[nodiscard]] GrowthNeeds growth_needs(const MarchWorld& skeleton);

// Grows the distances of such a level; those of all larger cells must have grown before.
void grow_level(MarchWorld& built, int log2);

}  // namespace voxilux
