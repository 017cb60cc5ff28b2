#pragma once

#include "scene/scene.h"
#include "scene/scene_bounds.h"
#include "shared/sky_view.h"

namespace voxilux {

// The atmosphere of a scene in the shaders' terms, seen from z = 0.
[[nodiscard]] gpu::SkyParams sky_params(const Scene& scene);

// Irradiance of a surface of the scene that faces the sun: zero when the sun is off or below the horizon. An
// atmosphere dims and colours it, and the planet hides what is below its horizon, as a mean over the disc.
[[nodiscard]] glm::vec3 sunlight(const Scene& scene);

// Fraction of the light that the atmosphere absorbs or scatters over a horizontal distance at z = 0, in the
// channel that loses most.
[[nodiscard]] float haze(const Scene& scene, double voxels);

// Below this haze, the air between camera and surfaces is not worth its time.
inline constexpr float kVisibleHaze = 0.001f;

// The haze over the distance from the camera to the farthest surface. `voxels`: their box.
[[nodiscard]] float haze_before_surfaces(const Scene& scene, const Box& voxels);

}  // namespace voxilux
