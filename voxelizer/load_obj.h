#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "voxelizer/load_mesh.h"
#include "voxelizer/mesh_notes.h"

namespace voxilux {

// The mesh in the bytes of an OBJ file. Its MTL files and their textures are looked up in `folder`, also by
// their last component where they are given with a path of another machine. Polygons are cut into triangles.
// Vertex colours are sRGB, factors of the MTL linear. Throws MeshFault.
[[nodiscard]] Mesh load_obj(std::span<const std::byte> bytes, const std::filesystem::path& folder,
                            const MeshRequest& request, MeshNotes& notes);

}  // namespace voxilux
