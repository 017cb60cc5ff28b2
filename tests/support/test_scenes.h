#pragma once

// Scenes built in code, for tests whose numbers depend on where each voxel is.

#include <glm/glm.hpp>

#include "scene/scene.h"

namespace voxilux::test {

// One white diffuse material (albedo 1), no sun, a white sky of radiance 1, one pixel. Occlusion of each
// pixel stands for light between surfaces.
[[nodiscard]] Scene white_scene();

// Fills the scene cells from <= c < to with a material.
void add_box(Scene& scene, glm::ivec3 from, glm::ivec3 to, std::uint16_t material = 0);

// A camera that looks straight down from `position` with +y up in the picture.
[[nodiscard]] Camera camera_down(glm::dvec3 position, double fov_y_deg);

// A camera at `position` that looks at `target`.
[[nodiscard]] Camera camera_towards(glm::dvec3 position, glm::dvec3 target, double fov_y_deg = 45.0);

// A large plane seen from above, lit by a sun of this diameter and by a sky that nothing hides: sun and sky
// are the same everywhere.
[[nodiscard]] Scene lit_plane(float angular_diameter_deg);

// Scene cells of all voxels.
[[nodiscard]] std::vector<glm::ivec3> scene_cells(const Scene& scene);

}  // namespace voxilux::test
