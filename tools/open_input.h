#pragma once

#include "scene_options.h"

namespace voxilux {

// The scene with the flags applied. An input that is neither .vox nor .toml is converted to voxels; with
// `says_notes`, standard error says how. Throws Error(input_refused) for a file.
[[nodiscard]] Scene load_scene_with(const SceneOptions& options, bool says_notes = false);

}  // namespace voxilux
