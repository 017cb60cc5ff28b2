#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "voxelizer/load_mesh.h"

namespace voxilux {

// Texels of all images of a file so far, checked against limits.texels.
struct TexelBudget {
    MeshLimits limits;
    std::uint64_t taken = 0;
};

// The texels of a PNG or JPEG image, with `name`. Its size is checked against the budget before anything is
// decoded. Throws MeshFault with the reason.
[[nodiscard]] Texture decode_texture(std::span<const std::byte> bytes, const std::string& name,
                                     TexelBudget& budget);

}  // namespace voxilux
