#include "passes/primary/sphere.h"

namespace voxilux {

Plane record_sphere_trace(const RenderPlan& plan, const DispatchTile& tile, const Plane& voxel_hits,
                          Recording& recording) {
    const Plane hits{declare_plane<gpu::Hit>(plan, "sphere.hits", recording)};
    std::vector<Constant> constants = surface_constants(plan);
    constants.push_back({"hits_stride", voxel_hits.stride});
    recording.dispatch({.label = "sphere.trace",
                        .shader = "sphere_trace",
                        .extent = pixel_extent(plan, tile),
                        .bindings = {{"Frame", frame_buffer(recording)},
                                     {"Spheres", spheres_buffer(plan, recording)},
                                     {"SphereTable", sphere_table_buffer(plan, recording)},
                                     {"SphereTree", sphere_tree_buffer(plan, recording)},
                                     {"VoxelHits", voxel_hits.buffer},
                                     {"Hits", hits.buffer}},
                        .constants = std::move(constants)});
    return hits;
}

}  // namespace voxilux
