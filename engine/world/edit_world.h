#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "world/march_world.h"

namespace voxilux {

struct VoxelEdit {
    glm::ivec3 local{0};      // inside the world
    std::uint16_t voxel = 0;  // 16 bits as VoxelWorld::get gives them: kEmpty clears the cell
};

// The words first <= i < end of an array.
struct WordRange {
    std::size_t first = 0;
    std::size_t end = 0;
};

// Where words may have changed, ascending.
struct WorldChanges {
    bool is_rebuilt = false;  // all of them
    std::vector<WordRange> roots;
    std::vector<WordRange> nodes;
    std::vector<WordRange> leaves;
};

// Sets and clears voxels in a world and in its structure. Afterwards every cell and every box is what
// build_march_world would make of the edited world; blocks of leaves may be numbered differently, and unused
// ones stay. For wide and deep, only the boxes around the edits are redone: up to one brick around an edit
// inside bricks that stay mixed, up to 31 cells around a brick or chunk that becomes empty or stops being so.
// The other structures are built anew.
WorldChanges edit_world(VoxelWorld& world, MarchWorld& built, std::span<const VoxelEdit> edits);

}  // namespace voxilux
