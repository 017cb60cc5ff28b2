#pragma once

#include <cstddef>
#include <vector>

#include "scene/vox_file.h"

namespace voxilux {

// The bytes of a .vox file that MagicaVoxel opens and that read_vox gives back equal but for its warnings.
// Chunks come in MagicaVoxel's order. An RGBA chunk (always 256 colours) is written when the palette is the
// file's own or is not the default one. Throws Error(cannot_write) over the format's 4 GiB.
[[nodiscard]] std::vector<std::byte> write_vox(const VoxFile& file);

}  // namespace voxilux
