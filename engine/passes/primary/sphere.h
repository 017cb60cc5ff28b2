#pragma once

#include "passes/plane.h"

namespace voxilux {

// The hits with analytic spheres in front of them.
[[nodiscard]] Plane record_sphere_trace(const RenderPlan& plan, const Slice& slice, const Plane& voxel_hits,
                                        Recording& recording);

}  // namespace voxilux
