#pragma once

#include "world/march_world.h"

namespace voxilux {

// Fill the arrays of `built`, whose traversal and size are set, as world_cell.h says. build_bytes throws
// Error(out_of_memory) when the world has more materials than a byte can number.
void build_bytes(const VoxelWorld& world, MarchWorld& built);
void build_masks(const VoxelWorld& world, MarchWorld& built);

}  // namespace voxilux
