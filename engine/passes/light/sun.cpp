#include "passes/light/sun.h"

namespace voxilux {

Plane record_sun_trace(const RenderPlan& plan, const DispatchTile& tile, const Plane& hits,
                       Recording& recording) {
    return record_surface_pass(plan, tile, {"sun.trace", "sun_trace", "Sun", "sun.lit"}, hits, recording);
}

}  // namespace voxilux
