#include "passes/specular/specular.h"

namespace voxilux {

std::vector<Binding> path_bindings(const RenderPlan& plan, Recording& recording) {
    return {{"Frame", frame_buffer(recording)},
            {"Counters", counters_buffer(recording)},
            {"Spheres", spheres_buffer(plan, recording)},
            {"SphereTable", sphere_table_buffer(plan, recording)},
            {"SphereTree", sphere_tree_buffer(plan, recording)},
            {"Materials", materials_buffer(plan, recording)}};
}

std::vector<Constant> path_constants(const RenderPlan& plan) {
    const bool specular = plan.has(Effect::specular);
    std::vector<Constant> constants = surface_constants(plan);
    constants.push_back({"has_glass_voxels", specular && plan.has_glass_voxels ? 1u : 0u});
    return constants;
}

SpecularPlanes record_specular_trace(const RenderPlan& plan, const DispatchTile& tile,
                                     const Plane& first_hits, Recording& recording) {
    const SpecularPlanes planes{.hits = {declare_plane<gpu::Hit>(plan, "specular.hits", recording)},
                                .weights = {declare_plane<gpu::vec3>(plan, "specular.weights", recording)}};
    Dispatch dispatch{.label = "specular.trace",
                      .shader = "specular_trace",
                      .extent = pixel_extent(plan, tile),
                      .bindings = path_bindings(plan, recording),
                      .constants = path_constants(plan)};
    dispatch.bindings.insert(
        dispatch.bindings.end(),
        {{"FirstHits", first_hits.buffer},
         {"Hits", planes.hits.buffer},
         {"Weights", planes.weights.buffer},
         {"Starts", plan.shows_rough ? declare_plane<gpu::PathStart>(plan, "path.starts", recording)
                                     : placeholder_buffer(recording)}});
    dispatch.constants.insert(
        dispatch.constants.end(),
        {{"has_rough", plan.shows_rough ? 1u : 0u}, {"keeps_normals", plan.paths_keep_normals() ? 1u : 0u}});
    point_to_world(plan.world.traversal, world_buffers(plan, recording), dispatch);
    recording.dispatch(std::move(dispatch));
    return planes;
}

}  // namespace voxilux
