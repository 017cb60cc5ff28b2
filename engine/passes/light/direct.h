#pragma once

#include "passes/plane.h"

namespace voxilux {

// Light that each hit receives directly from emitters, irradiance / pi.
[[nodiscard]] Plane record_direct_trace(const RenderPlan& plan, const DispatchTile& tile, const Plane& hits,
                                        Recording& recording);

}  // namespace voxilux
