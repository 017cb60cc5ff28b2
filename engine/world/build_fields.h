#pragma once

#include "world/march_world.h"

namespace voxilux {

// Fills the arrays of `built`, whose traversal (one with boxes) and size are set, as world_cell.h says.
void build_fields(const VoxelWorld& world, MarchWorld& built);

// The same without the boxes that leave their parent: what the device starts from. Those distances are 0.
void build_skeleton(const VoxelWorld& world, MarchWorld& built);

// Grows the distances of the cells of edge 2^log2 voxels; those of all larger cells must have grown before.
void grow_level(MarchWorld& built, int log2);

}  // namespace voxilux
