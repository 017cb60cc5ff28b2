#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "voxelizer/load_mesh.h"
#include "voxelizer/mesh_notes.h"

namespace voxilux {

// A point cloud of a laser scanner: LAS 1.0 to 1.4, every point format, with the colours of those that have
// them. z up. LAZ, its compressed form, is refused. `folder` is not used. Throws MeshFault.
[[nodiscard]] Mesh load_las(std::span<const std::byte> bytes, const std::filesystem::path& folder,
                            const MeshRequest& request, MeshNotes& notes);

}  // namespace voxilux
