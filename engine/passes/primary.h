#pragma once

#include "passes/plane.h"

namespace voxilux {

// First voxel along each camera ray.
[[nodiscard]] Plane record_primary_march(const RenderPlan& plan, const Slice& slice, Recording& recording);

}  // namespace voxilux
