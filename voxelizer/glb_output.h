#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "scene/vox_file.h"

namespace voxilux {

struct GlbOutput {
    std::vector<std::byte> bytes;
    std::uint64_t voxels = 0;
    std::uint64_t quads = 0;
};

// The visible voxels of a file at frame 0 as a mesh for game engines (binary glTF 2.0): rectangles of one
// palette index, flat normals, one texture of 256 x 1 texels that holds the palette, one material for each
// kind of surface. A voxel is one unit long; z up becomes y up. Deterministic. Throws Error(input_refused)
// when the graph cannot be traversed, no voxel is visible, or the file would exceed 4 GiB.
[[nodiscard]] GlbOutput glb_of(const VoxFile& file);

}  // namespace voxilux
