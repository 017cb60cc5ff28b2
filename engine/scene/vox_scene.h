#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "scene/scene.h"
#include "scene/vox_file.h"

namespace voxilux {

// Most voxels of all visible instances together. A file above it is refused here, with its name, not later by
// a failed allocation. 2^31 is twice a solid 1024^3 scene.
inline constexpr std::uint64_t kVoxMaxInstancedVoxels = std::uint64_t{1} << 31;

struct VoxSceneOptions {
    int frame = 0;  // of animated transforms and shapes, see vox_instances
};

// The file as a scene: the models that a visible instance shows, one material for each palette index that
// they use, the warnings of the file. Sun, sky and settings are the defaults. Throws Error(input_refused)
// when the graph cannot be walked or a limit is exceeded. The scene is still.
[[nodiscard]] Scene scene_from_vox(const VoxFile& file, VoxSceneOptions options = {});

// Adds the file's models, materials and warnings to `scene`; returns its visible instances, in the file's own
// space and not yet in the scene, for place_instances. Adding once and placing often keeps one copy of the
// voxels. Throws as scene_from_vox does.
[[nodiscard]] std::vector<Instance> add_vox_models(Scene& scene, const VoxFile& file, int frame);

// As add_vox_models with the models of all frames, for an animated file.
[[nodiscard]] AnimatedVox add_animated_vox(Scene& scene, const VoxFile& file);

// The visible instances of an added file at `frame`, in the file's own space. Throws as scene_from_vox does.
[[nodiscard]] std::vector<Instance> visible_instances(std::span<const VoxelModel> models,
                                                      const AnimatedVox& file, std::int64_t frame);

// Appends instances under an outer placement: cell c goes to floor(rotation (c + 1/2)) + translation, so it
// turns about the low corner of cell (0, 0, 0). Exact. Throws Error(input_refused) beyond kVoxMaxTranslation.
void place_instances(std::vector<Instance>& into, std::span<const Instance> instances,
                     const Rotation& rotation, glm::ivec3 translation);

// A file whose models are in a scene, to be placed there any number of times.
struct AddedVox {
    std::vector<Instance> instances;      // of the frame it was added for
    std::optional<std::size_t> animated;  // in Animation::files; nothing when all frames are alike
};

// Adds a file that is animated with the scene; the instances are those of `frame`. Throws as scene_from_vox
// does.
[[nodiscard]] AddedVox add_vox(Scene& scene, const VoxFile& file, std::int64_t frame);

// Adds its instances to the scene as place_instances does, with what later frames need.
void place_vox(Scene& scene, const AddedVox& added, const Rotation& rotation, glm::ivec3 translation);

// add_vox_models, then place_instances.
void append_vox(Scene& scene, const VoxFile& file, int frame, const Rotation& rotation,
                glm::ivec3 translation);

}  // namespace voxilux
