#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "voxelizer/load_mesh.h"
#include "voxelizer/mesh_notes.h"

namespace voxilux {

// A .ply file: vertices with colours, and faces. Without faces it is a point cloud: positions and no
// triangles. z up. `folder` is not used. Throws MeshFault.
[[nodiscard]] Mesh load_ply(std::span<const std::byte> bytes, const std::filesystem::path& folder,
                            const MeshRequest& request, MeshNotes& notes);

}  // namespace voxilux
