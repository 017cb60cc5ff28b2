#include "passes/photons/photon_trace.h"

#include "passes/photons/photon_buffers.h"
#include "passes/specular/specular.h"
#include "shared/alias.h"

namespace voxilux {
namespace {

std::string aim_maps_buffer(const RenderPlan& plan, Recording& recording) {
    return declare<gpu::AimMap>(recording, "photon.aim_maps", plan.world.lights.aims->maps,
                                Lifetime::persistent);
}

std::string aim_cells_buffer(const RenderPlan& plan, Recording& recording) {
    return declare<gpu::uvec2>(recording, "photon.aim_cells", plan.world.lights.aims->cells,
                               Lifetime::persistent);
}

std::string light_maps_buffer(const RenderPlan& plan, Recording& recording) {
    return declare<gpu::uint>(recording, "photon.light_maps", plan.world.lights.count, Lifetime::persistent);
}

// Draws an emitter by the power that its map lets through.
std::string aimed_table_buffer(const RenderPlan& plan, Recording& recording) {
    return declare<gpu::AliasEntry>(recording, "photon.light_table", plan.world.lights.count,
                                    Lifetime::persistent);
}

// The buffer, or the placeholder where the photons of the plan need none.
std::string buffer_if(bool is_needed, const RenderPlan& plan,
                      std::string (*buffer)(const RenderPlan&, Recording&), Recording& recording) {
    return is_needed ? buffer(plan, recording) : placeholder_buffer(recording);
}

}  // namespace

void record_photon_aims(const RenderPlan& plan, const PhotonAims& aims, Recording& recording) {
    if (!plan.photons.aims) return;
    recording.upload(aim_maps_buffer(plan, recording), std::as_bytes(std::span(aims.maps)));
    recording.upload(aim_cells_buffer(plan, recording), std::as_bytes(std::span(aims.cells)));
    if (plan.photons.emitter_photons == 0) return;
    recording.upload(light_maps_buffer(plan, recording), std::as_bytes(std::span(aims.map_of_light)));
    recording.upload(aimed_table_buffer(plan, recording), std::as_bytes(std::span(aims.table)));
}

void record_photon_emit(const RenderPlan& plan, Recording& recording) {
    const bool aims = plan.photons.aims, emits = plan.photons.emitter_photons != 0;
    std::vector<Constant> constants = surface_constants(plan);
    constants.push_back({"aims", aims ? 1u : 0u});
    recording.dispatch(
        {.label = "photon.emit",
         .shader = "photon_emit",
         .extent = {plan.photons.at_once, 1, 1},
         .bindings = {{"Frame", frame_buffer(recording)},
                      {"PhotonFrame", photon_frame_buffer(recording)},
                      {"Spheres", spheres_buffer(plan, recording)},
                      {"Materials", materials_buffer(plan, recording)},
                      {"Lights", buffer_if(emits, plan, lights_buffer, recording)},
                      {"LightTable",
                       buffer_if(emits, plan, aims ? aimed_table_buffer : light_table_buffer, recording)},
                      {"AimMaps", buffer_if(aims, plan, aim_maps_buffer, recording)},
                      {"AimCells", buffer_if(aims, plan, aim_cells_buffer, recording)},
                      {"LightMaps", buffer_if(aims && emits, plan, light_maps_buffer, recording)},
                      {"Starts", declare<gpu::PhotonStart>(recording, "photon.rays", plan.photons.at_once)}},
         .constants = std::move(constants)});
}

void record_photon_trace(const RenderPlan& plan, Recording& recording) {
    const PhotonSettings& settings = plan.settings.photons;
    Dispatch dispatch{.label = "photon.trace",
                      .shader = "photon_trace",
                      .extent = {plan.photons.lanes, 1, 1},
                      .bindings = path_bindings(plan, recording),
                      .constants = path_constants(plan)};
    dispatch.constants.insert(dispatch.constants.end(),
                              {{"keeps_caustics", plan.is_by_photons(Effect::caustics) ? 1u : 0u},
                               {"keeps_indirect", plan.is_by_photons(Effect::indirect) ? 1u : 0u},
                               {"sends_caustics_on", plan.sends_caustics_on() ? 1u : 0u},
                               {"sorts_photons", settings.scatter ? 0u : 1u},
                               {"lanes", plan.photons.lanes},
                               {"slots_at_once", plan.photons.slots_at_once},
                               {"start_anywhere", 1u},
                               {"depth_limit", settings.roulette ? 0u : settings.depth}});
    dispatch.bindings.push_back(
        {"Starts", declare<gpu::PhotonStart>(recording, "photon.rays", plan.photons.at_once)});
    dispatch.bindings.insert(dispatch.bindings.end(),
                             {{"PhotonFrame", photon_frame_buffer(recording)},
                              {"PhotonHeads", photon_head_buffer(recording)},
                              {"StoredPhotons", photon_store_buffer(plan, recording)},
                              {"WantedCells", photon_wanted_buffer(plan, recording)},
                              {"BucketCounts", photon_counts_buffer(plan, recording)}});
    point_to_world(plan.world.traversal, world_buffers(plan, recording), dispatch);
    recording.dispatch(std::move(dispatch));
}

}  // namespace voxilux
