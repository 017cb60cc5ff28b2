#pragma once

#include <filesystem>
#include <string>

namespace voxilux {

// The result of voxelizing a mesh that was dropped.
struct VoxelizedMesh {
    std::string file;  // a new .vox in the current folder, named after the mesh
    std::string said;
};

// Voxelizes as `voxilux voxelize` without flags. Warnings go to standard error. Throws as load_mesh,
// voxelize_mesh and write_voxels.
[[nodiscard]] VoxelizedMesh voxelize_drop(const std::filesystem::path& mesh);

// A name that no file has: stem + ending, then stem.001 + ending and so on.
[[nodiscard]] std::string unused_name(const std::string& stem, const std::string& ending, int first = 0);

}  // namespace voxilux
