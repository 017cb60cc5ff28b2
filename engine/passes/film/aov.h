#pragma once

#include "passes/plane.h"

namespace voxilux {

// Position and depth of each hit, straight into the film: they are those of one sample, not means.
void record_aov_position(const RenderPlan& plan, const DispatchTile& tile, const Plane& hits,
                         Recording& recording);

}  // namespace voxilux
