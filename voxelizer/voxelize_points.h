#pragma once

#include "voxelizer/voxelize_mesh.h"

namespace voxilux {

// A cloud of points as voxels: every cell that holds a point, with the mean of their colours in linear light.
// The grid is that of a mesh, around the finite points; others are counted in `dropped`. Memory: 16 bytes for
// a point besides the mesh. Throws what grid_of throws.
[[nodiscard]] VoxelSet voxelize_points(const Mesh& mesh, const GridRequest& request);

}  // namespace voxilux
