#include "passes/sphere.h"

namespace voxilux {

Plane record_sphere_trace(const RenderPlan& plan, const Slice& slice, const Plane& voxel_hits, Recording& recording) {
    const Plane hits{use_buffer(plan, "sphere.hits", recording)};
    Dispatch dispatch{.label = "sphere.trace",
                      .shader = "sphere_trace",
                      .extent = pixel_extent(plan, slice),
                      .bindings = surface_bindings(plan, recording),
                      .constants = surface_constants(plan)};
    dispatch.bindings.push_back({"VoxelHits", voxel_hits.buffer});
    dispatch.bindings.push_back({"Hits", hits.buffer});
    dispatch.constants.push_back({"hits_stride", voxel_hits.stride});
    recording.dispatch(std::move(dispatch));
    return hits;
}

}  // namespace voxilux
