#include "passes/primary.h"

namespace voxilux {

Plane record_primary_march(const RenderPlan& plan, const Slice& slice, Recording& recording) {
    const Plane hits{use_buffer(plan, "primary.hits", recording)};
    recording.dispatch({.label = "primary.march",
                        .shader = "primary_march",
                        .extent = pixel_extent(plan, slice),
                        .bindings = {{"Frame", use_buffer(plan, "frame", recording)},
                                     {"Tally", use_buffer(plan, "tally", recording)},
                                     {"Chunks", use_buffer(plan, "world.chunks", recording)},
                                     {"Bricks", use_buffer(plan, "world.bricks", recording)},
                                     {"Voxels", use_buffer(plan, "world.voxels", recording)},
                                     {"Hits", hits.buffer}}});
    return hits;
}

}  // namespace voxilux
