#pragma once

#include "base/step_times.h"
#include "scene_options.h"

namespace voxilux {

// The scene with the flags applied. An input that is neither .vox nor .toml is converted to voxels; with
// `says_notes`, standard error says how. Throws Error(input_refused) for a file.
// `times` gets the steps of loading.
[[nodiscard]] Scene load_scene_with(const SceneOptions& options, bool says_notes = false,
                                    StepTimes* times = nullptr);

}  // namespace voxilux
