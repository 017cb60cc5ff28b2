#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/step_times.h"
#include "scene/scene.h"
#include "scene/vox_file.h"

namespace voxilux {

struct LoadOptions {
    // "key=value" with a dotted key, as the -D option gives them: "sun.elevation=10", "sphere.0.radius=3".
    // The value is TOML, or else a string. Applied in order before anything is read.
    std::vector<std::string> overrides;
    bool ignores_file_settings = false;  // of a .vox file: how its author lit and framed it
    StepTimes* times = nullptr;          // gets the steps of loading
    int frame = 0;  // that the instances of animated .vox files show; scene_at_frame gives the others
};

// The scene of a .toml file (scenes/README.md describes it) or of a .vox file with its settings. Throws
// Error(input_refused) with one line "FILE:LINE:COLUMN: what is wrong, and what is allowed". Overrides of a
// .vox file may set all that a .toml file can.
[[nodiscard]] Scene load_scene(const std::filesystem::path& file, const LoadOptions& options = {});

// As load_scene for the voxels of a file of another kind; `file` names it in messages.
[[nodiscard]] Scene scene_of_file(const VoxFile& vox, const std::filesystem::path& file,
                                  const LoadOptions& options = {});

// As load_scene for the text of a .toml file; `file` names it in messages and its folder holds the models.
[[nodiscard]] Scene parse_scene(std::string_view text, const std::filesystem::path& file,
                                const LoadOptions& options = {});

}  // namespace voxilux
