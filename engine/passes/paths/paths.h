#pragma once

#include "passes/plane.h"

namespace voxilux {

// Light that each hit receives from the sky and by way of other surfaces, added to `direct`: irradiance / pi.
[[nodiscard]] Plane record_paths(const RenderPlan& plan, const DispatchTile& tile, const Plane& hits,
                                 const Plane& direct, Recording& recording);

}  // namespace voxilux
