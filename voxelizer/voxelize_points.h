#pragma once

#include "voxelizer/voxelize_mesh.h"

namespace voxilux {

// A point cloud as voxels: every cell that contains a point, with the mean colour of its points in linear
// light. The grid is that of a mesh, around the finite points; others are counted in `dropped`. Memory: 16
// bytes per point besides the mesh. Throws what grid_of throws.
[[nodiscard]] VoxelSet voxelize_points(const Mesh& mesh, const GridRequest& request);

}  // namespace voxilux
