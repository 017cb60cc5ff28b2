#include "passes/paths/paths.h"

#include "passes/sky/sky.h"
#include "passes/sky/sky_image.h"
#include "passes/specular/specular.h"

namespace voxilux {
namespace {

void record_path_start(const RenderPlan& plan, const DispatchTile& tile, const Plane& hits,
                       const std::string& starts, Recording& recording) {
    Dispatch dispatch{.label = "path.start",
                      .shader = "path_start",
                      .extent = pixel_extent(plan, tile),
                      .bindings = {{"Frame", frame_buffer(recording)},
                                   {"Counters", counters_buffer(recording)},
                                   {"Spheres", spheres_buffer(plan, recording)},
                                   {"Materials", materials_buffer(plan, recording)},
                                   {"Hits", hits.buffer},
                                   {"Starts", starts}},
                      .constants = path_constants(plan)};
    // Whether paths aim at images of the sun from visible points inside glass.
    const bool finds_media = plan.paths_find_sun_caustics && plan.has(Effect::sun) && plan.has_glass_voxels;
    dispatch.constants.push_back({"finds_media", finds_media ? 1u : 0u});
    dispatch.constants.push_back({"keeps_normals", plan.paths_keep_normals() ? 1u : 0u});
    dispatch.constants.push_back({"has_rough", plan.shows_rough ? 1u : 0u});
    point_to_world(plan.world.traversal, world_buffers(plan, recording), dispatch);
    recording.dispatch(std::move(dispatch));
}

Dispatch path_trace(const RenderPlan& plan, std::uint32_t lanes, const Plane& direct,
                    const std::string& starts, const std::string& light, Recording& recording) {
    const bool has_emitters = plan.has(Effect::emission) && plan.world.lights.count != 0;
    const std::string states =
        plan.paths.rounds > 1
            ? declare<gpu::PathState>(recording, "path.states", plan.path_lanes(plan.tile_rows))
            : placeholder_buffer(recording);
    Dispatch dispatch{.label = "path.trace",
                      .shader = "path_trace",
                      .extent = {lanes, 1, 1},
                      .bindings = path_bindings(plan, recording),
                      .constants = path_constants(plan)};
    const auto emitter_buffer = [&](std::string (*buffer)(const RenderPlan&, Recording&)) {
        return has_emitters ? buffer(plan, recording) : placeholder_buffer(recording);
    };
    dispatch.bindings.insert(dispatch.bindings.end(), {{"Lights", emitter_buffer(lights_buffer)},
                                                       {"LightTable", emitter_buffer(light_table_buffer)},
                                                       {"SkyTable", sky_table_buffer(plan, recording)},
                                                       {"Starts", starts},
                                                       {"Gains", gains_buffer(plan, recording)},
                                                       {"Direct", direct.buffer},
                                                       {"States", states},
                                                       {"Light", light}});
    const std::vector<Binding> sky = sky_bindings(plan, recording);
    dispatch.bindings.insert(dispatch.bindings.end(), sky.begin(), sky.end());
    dispatch.constants.insert(
        dispatch.constants.end(),
        {{"has_atmosphere", plan.has_atmosphere() ? 1u : 0u},
         {"traces_air", plan.traces_air() ? 1u : 0u},
         {"has_sun", plan.has(Effect::sun) ? 1u : 0u},
         {"has_emitters", has_emitters ? 1u : 0u},
         {"has_specular", plan.has(Effect::specular) ? 1u : 0u},
         {"has_images", plan.has(Effect::specular) && plan.has(Effect::voxels) ? 1u : 0u},
         {"finds_sun_caustics", plan.paths_find_sun_caustics ? 1u : 0u},
         {"finds_emitter_caustics", plan.is_by_paths(Effect::caustics) ? 1u : 0u},
         {"aims_at_emitters", plan.settings.paths.plain ? 0u : 1u},
         {"aims_at_sky", plan.paths_aim_at_sky() ? 1u : 0u},
         {"shares_direct", plan.paths_share_direct() ? 1u : 0u},
         {"keeps_normals", plan.paths_keep_normals() ? 1u : 0u},
         {"direct_stride", direct.stride},
         {"has_rounds", plan.paths.rounds > 1 ? 1u : 0u},
         {"has_rough", plan.shows_rough ? 1u : 0u},
         {"start_anywhere", plan.shows_rough ? 1u : 0u}});  // camera rays
    const std::vector<Constant> image = sky_image_constants(plan);
    dispatch.constants.insert(dispatch.constants.end(), image.begin(), image.end());
    point_to_world(plan.world.traversal, world_buffers(plan, recording), dispatch);
    return dispatch;
}

}  // namespace

Plane record_paths(const RenderPlan& plan, const DispatchTile& tile, const Plane& hits, const Plane& direct,
                   Recording& recording) {
    const std::string starts = declare_plane<gpu::PathStart>(plan, "path.starts", recording);
    const Plane light{declare_plane<gpu::vec3>(plan, "path.light", recording)};
    record_path_start(plan, tile, hits, starts, recording);
    const std::uint32_t lanes = plan.path_lanes(tile.row_count);
    const Dispatch dispatch = path_trace(plan, lanes, direct, starts, light.buffer, recording);
    if (plan.paths.rounds > 1) recording.clear("path.states");
    for (std::uint32_t round = 1; round <= plan.paths.rounds; ++round) {
        Dispatch trace = dispatch;
        trace.push = to_bytes(gpu::PathPush{.lanes = lanes, .is_last = round == plan.paths.rounds ? 1u : 0u});
        recording.dispatch(std::move(trace));
    }
    return light;
}

}  // namespace voxilux
