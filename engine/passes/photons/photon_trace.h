#pragma once

#include "passes/plane.h"

namespace voxilux {

// Uploads where photons start that are to meet mirrors or glass first, where the plan has such photons.
void record_photon_aims(const RenderPlan& plan, const PhotonAims& aims, Recording& recording);

// Draws where the photons of a sample start and traces them to diffuse surfaces. Fills the store of photons,
// which must be empty.
void record_photon_emit(const RenderPlan& plan, Recording& recording);
void record_photon_trace(const RenderPlan& plan, Recording& recording);

}  // namespace voxilux
