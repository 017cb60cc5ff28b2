#pragma once

#include <cstdint>
#include <vector>

#include "world/march_world.h"

namespace voxilux {

// Fills the arrays of `built`, whose traversal (one with boxes) and size are set, as world_cell.h says,
// except for the boxes that grow afterwards: their distances are 0.
void build_skeleton(const VoxelWorld& world, MarchWorld& built);

// log2 of the cell edges, in voxels, of the levels whose boxes grow, in the order they must grow in.
[[nodiscard]] std::vector<int> growing_levels(Traversal traversal);

// The words of the level of cells of edge 2^log2 voxels, and how many words a block of 64 cells takes.
[[nodiscard]] std::vector<std::uint32_t>& level_words(MarchWorld& built, int log2);
[[nodiscard]] const std::vector<std::uint32_t>& level_words(const MarchWorld& built, int log2);
[[nodiscard]] std::uint32_t block_words(int log2);

// Steps that the boxes of a level take to grow.
[[nodiscard]] std::uint32_t level_steps(int log2);

// Where the blocks of 64 cells of a level are (world_cell.h: pack_home); empty for chunks, which have no
// blocks.
[[nodiscard]] std::vector<glm::uvec2> level_homes(const MarchWorld& built, int log2);

// Grows the boxes of such a level; those of all larger cells must have grown before.
void grow_level(MarchWorld& built, int log2);

// Lets bricks that are equal in every bit point to the first of them, so that rays find it in the cache.
// Blocks that nobody points to stay where they are.
void share_leaves(MarchWorld& built);

// Whether the traversal shares leaves after growth.
[[nodiscard]] bool shares_leaves(Traversal traversal);

// What growing a skeleton on the device takes: bytes of scratch, and dispatches.
struct GrowthNeeds {
    std::uint64_t home_bytes = 0;
    std::uint64_t grown_bytes = 0;
    std::uint64_t table_bytes = 0;  // of the hash table that finds equal bricks
    std::uint64_t place_bytes = 0;  // where each brick is in that table
    std::uint64_t steps = 0;

    bool operator==(const GrowthNeeds&) const = default;
};
[[nodiscard]] GrowthNeeds growth_needs(const MarchWorld& skeleton);

}  // namespace voxilux
