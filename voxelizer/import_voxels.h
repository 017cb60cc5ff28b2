#pragma once

#include <filesystem>
#include <string>

#include "scene/vox_file.h"
#include "voxelizer/mesh_grid.h"

namespace voxilux {

// Files other than .vox, converted to what a .vox file holds: voxels of other programs and meshes.
struct ImportedVoxels {
    VoxFile file;
    std::string note;  // what was done, in one line
};

// Whether import_voxels reads files with this extension.
[[nodiscard]] bool is_importable(const std::filesystem::path& path);

// All of those extensions, for messages: ".qb, .kv6, ..."
[[nodiscard]] std::string importable_endings();

// Voxels keep their positions; a mesh is voxelized as by `voxilux voxelize` without flags, except for `grid`.
// More than 255 colours are quantized. Throws Error(input_refused) with one line that names the file.
[[nodiscard]] ImportedVoxels import_voxels(const std::filesystem::path& path, const GridRequest& grid);

}  // namespace voxilux
