#pragma once

#include "passes/plane.h"

namespace voxilux {

// Fraction of the sun's irradiance that each hit receives, cosine included.
[[nodiscard]] Plane record_sun_trace(const RenderPlan& plan, const DispatchTile& tile, const Plane& hits,
                                     Recording& recording);

}  // namespace voxilux
