#pragma once

#include "renderer/prepared_scene.h"
#include "vk/executor.h"

namespace voxilux {

// The radius of the first iteration of photons, voxels, for a scene that sets none: with it, half of the
// visible points that photons reach at all gather kPilotPhotons or more in an iteration. Found by single
// iterations of growing radius. The device must hold the world; the film is left dirty. Equal scenes, plans
// and devices give the same radius.
[[nodiscard]] double pilot_radius(const PreparedScene& prepared, const Scene& scene, Executor& executor);

// The median of the photon counts of kernels that are not 0; 0 when all are.
[[nodiscard]] double median_of_met(std::vector<float> photons);

}  // namespace voxilux
