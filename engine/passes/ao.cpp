#include "passes/ao.h"

namespace voxilux {

Plane record_ao_trace(const RenderPlan& plan, const Slice& slice, const Plane& hits, Recording& recording) {
    return record_surface_pass(plan, slice, {"ao.trace", "ao_trace", "Ao", "ao.open"}, hits, recording);
}

}  // namespace voxilux
