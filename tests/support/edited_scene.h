#pragma once

#include <span>

#include "renderer/editable_voxels.h"
#include "scene/scene.h"

namespace voxilux::test {

// The scene as it would be loaded with these edits made: one model, cell by cell.
[[nodiscard]] Scene edited_scene(const Scene& scene, std::span<const BoxEdit> edits);

}  // namespace voxilux::test
