#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "voxelizer/load_mesh.h"
#include "voxelizer/mesh_notes.h"

namespace voxilux {

// A point cloud as text, a point per line: x y z, or x y z red green blue with colours from 0 to 255. If any
// line has other numbers after its position, no point has a colour, with a warning. A first line with a
// single number, the number of points, is skipped. z up. `folder` is not used. Throws MeshFault.
[[nodiscard]] Mesh load_xyz(std::span<const std::byte> bytes, const std::filesystem::path& folder,
                            const MeshRequest& request, MeshNotes& notes);

}  // namespace voxilux
