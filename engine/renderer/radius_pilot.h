#pragma once

#include "renderer/prepared_scene.h"
#include "vk/executor.h"

namespace voxilux {

// The first radius of photons, voxels, for a scene whose author names none: one with which the disc of half
// of the visible points that photons reach at all receives kPilotPhotons or more in an iteration. Found by
// single iterations of growing radius. The device holds the world; the film is left dirty. The same for
// equal scenes, plans and devices.
[[nodiscard]] double pilot_radius(const PreparedScene& prepared, const Scene& scene, Executor& executor);

// The middle of the photons per disc that are not 0; 0 when all are.
[[nodiscard]] double median_of_met(std::vector<float> photons);

}  // namespace voxilux
