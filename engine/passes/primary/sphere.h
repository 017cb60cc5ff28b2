#pragma once

#include "passes/plane.h"

namespace voxilux {

// The hits, replaced where an analytic sphere is nearer.
[[nodiscard]] Plane record_sphere_trace(const RenderPlan& plan, const DispatchTile& tile,
                                        const Plane& voxel_hits, Recording& recording);

}  // namespace voxilux
