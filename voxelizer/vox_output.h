#pragma once

#include <filesystem>
#include <string>

#include "voxelizer/mesh.h"
#include "voxelizer/voxel_palette.h"
#include "voxelizer/voxelize_mesh.h"

namespace voxilux {

struct VoxOutput {
    std::size_t models = 0;
    std::uint64_t voxels = 0;
    std::uint64_t bytes = 0;
};

// Writes the voxels as a .vox file: models of at most 256^3 with tight sizes on a grid, one transform each,
// in a group called `name`, the middle of the grid above the origin and its floor at z = 0; the palette,
// MATL, one layer, and the cameras of the mesh. Under a temporary name first. Throws Error(cannot_write).
VoxOutput write_voxels(const std::filesystem::path& file, const VoxelSet& set, const VoxelPalette& palette,
                       const Mesh& mesh, const std::string& name);

}  // namespace voxilux
