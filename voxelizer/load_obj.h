#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "voxelizer/load_mesh.h"
#include "voxelizer/mesh_notes.h"

namespace voxilux {

// The mesh of an OBJ file's bytes; its MTL files and their textures are looked for in `folder`, also by their
// last name where they are given with the path of another machine. Polygons are cut into triangles. Vertex
// colours count as sRGB, factors of the MTL as linear. Throws MeshFault.
[[nodiscard]] Mesh load_obj(std::span<const std::byte> bytes, const std::filesystem::path& folder,
                            const MeshRequest& request, MeshNotes& notes);

}  // namespace voxilux
