#pragma once

#include "passes/plane.h"

namespace voxilux {

struct SurfacePlanes {
    Plane albedo;
    Plane normal;
};

// Albedo and normal of each hit.
[[nodiscard]] SurfacePlanes record_aov_surface(const RenderPlan& plan, const DispatchTile& tile,
                                               const Plane& hits, Recording& recording);

// Position and depth of each hit, straight into the film: they are those of one sample, not means.
void record_aov_position(const RenderPlan& plan, const DispatchTile& tile, const Plane& hits,
                         Recording& recording);

}  // namespace voxilux
