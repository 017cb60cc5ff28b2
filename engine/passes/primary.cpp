#include "passes/primary.h"

namespace voxilux {

Plane record_primary_march(const RenderPlan& plan, const Slice& slice, Recording& recording) {
    const Plane hits{use_buffer(plan, "primary.hits", recording)};
    Dispatch dispatch{.label = "primary.march",
                      .shader = "primary_march",
                      .extent = pixel_extent(plan, slice),
                      .bindings = {{"Frame", use_buffer(plan, "frame", recording)},
                                   {"Tally", use_buffer(plan, "tally", recording)},
                                   {"Hits", hits.buffer}}};
    point_to_world(plan.world.traversal, world_buffers(plan, recording), dispatch);
    recording.dispatch(std::move(dispatch));
    return hits;
}

}  // namespace voxilux
