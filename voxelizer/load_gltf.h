#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "voxelizer/load_mesh.h"
#include "voxelizer/mesh_notes.h"

namespace voxilux {

// The mesh in the bytes of a .gltf or .glb file; files that it names are looked up in `folder`. Triangles
// whose vertices are not finite are left out and noted. Throws MeshFault, or Error for a file that it names.
[[nodiscard]] Mesh load_gltf(std::span<const std::byte> bytes, const std::filesystem::path& folder,
                             const MeshRequest& request, MeshNotes& notes);

}  // namespace voxilux
