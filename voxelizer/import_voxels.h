#pragma once

#include <filesystem>
#include <string>

#include "scene/vox_file.h"
#include "voxelizer/mesh_grid.h"

namespace voxilux {

// Files that are no .vox, made what a .vox file says: voxels of other programs and meshes.
struct ImportedVoxels {
    VoxFile file;
    std::string note;  // what was done, in one line
};

// Whether the file's ending is one of those that import_voxels reads.
[[nodiscard]] bool is_importable(const std::filesystem::path& path);

// All of those endings, for messages: ".qb, .kv6, ..."
[[nodiscard]] std::string importable_endings();

// Voxels keep their places; a mesh is voxelized as `voxilux voxelize` does without flags, but for `grid`.
// Over 255 colours are quantized. Throws Error(input_refused) with one line that names the file.
[[nodiscard]] ImportedVoxels import_voxels(const std::filesystem::path& path, const GridRequest& grid);

}  // namespace voxilux
