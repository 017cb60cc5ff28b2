#pragma once

#include "formats/voxel_cells.h"
#include "voxelizer/voxelize_mesh.h"

namespace voxilux {

// The cells as a set of voxels that keep their positions: cell (0, 0, 0) is at the origin of the
// scene. `voxels` holds at least one, and spans at most kMaxCellSide. Consumes them, so that memory holds
// them once.
[[nodiscard]] VoxelSet voxel_set_of(VoxelCells&& voxels);

}  // namespace voxilux
