#pragma once

#include <vector>

#include "scene/vox_file.h"

namespace voxilux {

// The render settings of a file: its rOBJ, and after them what the chunks of older files say (rLIT rAIR rLEN
// POST rDIS), by the names of rOBJ. At most kVoxMaxObjects; older chunks that cannot be read are left out.
[[nodiscard]] std::vector<VoxDict> render_objects(const VoxFile& file);

inline constexpr std::size_t kVoxMaxObjects = 256;

}  // namespace voxilux
