#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "voxelizer/load_mesh.h"
#include "voxelizer/mesh_notes.h"

namespace voxilux {

// An STL file (3D Systems, "SLC/STL file format", 1988): text, or binary where the number of triangles fits
// the file's size. White; z up, as in programs for 3D printing. `folder` is not used. Throws MeshFault.
[[nodiscard]] Mesh load_stl(std::span<const std::byte> bytes, const std::filesystem::path& folder,
                            const MeshRequest& request, MeshNotes& notes);

}  // namespace voxilux
