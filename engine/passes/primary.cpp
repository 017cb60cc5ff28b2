#include "passes/primary.h"

namespace voxilux {

Plane record_primary_march(const RenderPlan& plan, const Slice& slice, Recording& recording) {
    const Plane hits{use_buffer(plan, "primary.hits", recording)};
    recording.dispatch({.label = "primary.march",
                        .shader = "primary_march",
                        .extent = pixel_extent(plan, slice),
                        .bindings = {{"Frame", use_buffer(plan, "frame", recording)},
                                     {"Tally", use_buffer(plan, "tally", recording)},
                                     {"Roots", use_buffer(plan, "world.roots", recording)},
                                     {"Nodes", use_buffer(plan, "world.nodes", recording)},
                                     {"Leaves", use_buffer(plan, "world.leaves", recording)},
                                     {"Hits", hits.buffer}},
                        .constants = {traversal_constant(plan)}});
    return hits;
}

}  // namespace voxilux
