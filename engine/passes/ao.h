#pragma once

#include "passes/plane.h"

namespace voxilux {

// Openness of each hit: the share of cosine-weighted rays that meet nothing within the radius, by brute
// force.
[[nodiscard]] Plane record_ao_trace(const RenderPlan& plan, const Slice& slice, const Plane& hits,
                                    Recording& recording);

}  // namespace voxilux
