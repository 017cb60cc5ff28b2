#pragma once

#include "base/step_times.h"
#include "scene_options.h"

namespace voxilux {

// The scene with the flags applied. Throws Error(input_refused) for a file.
// An input that is neither .vox nor .toml is made voxels; with `says_notes` standard error says what was
// done.
// `times` gets the steps of loading.
[[nodiscard]] Scene load_scene_with(const SceneOptions& options, bool says_notes = false,
                                    StepTimes* times = nullptr);

}  // namespace voxilux
