#include "passes/light/direct.h"

#include "passes/specular/specular.h"

namespace voxilux {

Plane record_direct_trace(const RenderPlan& plan, const DispatchTile& tile, const Plane& hits,
                          Recording& recording) {
    const Plane direct{declare_plane<gpu::vec3>(plan, "direct.light", recording)};
    Dispatch dispatch{.label = "direct.trace",
                      .shader = "direct_trace",
                      .extent = pixel_extent(plan, tile),
                      .bindings = path_bindings(plan, recording),
                      .constants = path_constants(plan)};
    dispatch.bindings.insert(dispatch.bindings.end(), {{"Lights", lights_buffer(plan, recording)},
                                                       {"LightTable", light_table_buffer(plan, recording)},
                                                       {"Hits", hits.buffer},
                                                       {"Direct", direct.buffer}});
    dispatch.constants.push_back({"rays", plan.paths_share_direct() ? 1u : 2u});
    point_to_world(plan.world.traversal, world_buffers(plan, recording), dispatch);
    recording.dispatch(std::move(dispatch));
    return direct;
}

}  // namespace voxilux
