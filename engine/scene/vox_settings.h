#pragma once

#include <optional>
#include <span>
#include <vector>

#include "scene/scene.h"
#include "scene/vox_file.h"

namespace voxilux {

// Gives a scene what its .vox file says about light, air, ground, background, lens, film and cameras.
// `objects` are the file's render settings (rOBJ). The editor writes its own defaults into every file: an
// object that holds nothing else is ignored. What cannot be shown becomes a note, one for each setting.
// scenes/README.md says what each setting becomes.
void apply_vox_settings(const VoxFile& file, std::span<const VoxDict> objects, Scene& scene);

// The cameras that were saved (rCAM), named by their numbers; slots that nobody has used are left out.
[[nodiscard]] std::vector<SavedCamera> saved_cameras(const VoxFile& file);

inline constexpr std::size_t kVoxMaxCameras = 256;

}  // namespace voxilux
