#pragma once

#include "passes/photons/photon.h"

namespace voxilux {

// The light of photons at each hit by the technique of the plan, in an iteration counted from 1; black
// without photons. The tile is the whole crop window.
[[nodiscard]] PhotonPlanes record_photons(const RenderPlan& plan, const DispatchTile& tile, const Plane& hits,
                                          std::uint32_t iteration, Recording& recording);

}  // namespace voxilux
