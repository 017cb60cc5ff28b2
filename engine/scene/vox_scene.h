#pragma once

#include <span>
#include <vector>

#include "scene/scene.h"
#include "scene/vox_file.h"

namespace voxilux {

// Voxels of all visible instances together: what the world has to hold at most. Above it a file is refused
// here, by its name, not later by an allocation. 2^31 is twice a solid 1024^3 scene.
inline constexpr std::uint64_t kVoxMaxInstancedVoxels = std::uint64_t{1} << 31;

struct VoxSceneOptions {
    int frame = 0;  // of animated transforms and shapes, see vox_instances
};

// The file as a scene: the models that a visible instance shows, one material for each palette index that
// they use, the warnings of the file. Sun, sky and settings are the defaults. Throws Error(input_refused)
// when the graph cannot be walked or a limit is exceeded.
[[nodiscard]] Scene scene_from_vox(const VoxFile& file, VoxSceneOptions options = {});

// Adds the file's models, materials and warnings to `scene`; returns its visible instances, in the file's own
// space and not yet in the scene, for place_instances. Adding once and placing often keeps one copy of the
// voxels. Throws as scene_from_vox does.
[[nodiscard]] std::vector<Instance> add_vox_models(Scene& scene, const VoxFile& file, int frame);

// Adds instances to the scene under an outer placement: cell c goes to floor(rotation (c + 1/2)) +
// translation, so it turns about the low corner of cell (0, 0, 0). Exact. Throws Error(input_refused) beyond
// kVoxMaxTranslation.
void place_instances(Scene& scene, std::span<const Instance> instances, const Rotation& rotation,
                     glm::ivec3 translation);

// add_vox_models, then place_instances.
void append_vox(Scene& scene, const VoxFile& file, int frame, const Rotation& rotation,
                glm::ivec3 translation);

}  // namespace voxilux
