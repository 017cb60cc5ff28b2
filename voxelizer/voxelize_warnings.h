#pragma once

#include <string>
#include <vector>

#include "voxelizer/voxel_palette.h"
#include "voxelizer/voxelize_mesh.h"

namespace voxilux {

// What the user should know about a mesh and its voxels, one line each.
[[nodiscard]] std::vector<std::string> warnings_of(const Mesh& mesh, const VoxelSet& set, InsideRule inside,
                                                   const PaletteError& error);

}  // namespace voxilux
