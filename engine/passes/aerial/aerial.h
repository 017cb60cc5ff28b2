#pragma once

#include "passes/plane.h"

namespace voxilux {

struct AerialPlanes {
    Plane weights;  // what the radiance of hits is multiplied by
    Plane light;    // that the air before the first hits adds
};

// The air between the camera and its first hits, where the plan has_aerial().
[[nodiscard]] AerialPlanes record_aerial_trace(const RenderPlan& plan, const DispatchTile& tile,
                                               const Plane& first_hits, const Plane& weights,
                                               Recording& recording);

}  // namespace voxilux
