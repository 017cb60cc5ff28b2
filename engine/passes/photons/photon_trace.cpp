#include "passes/photons/photon_trace.h"

#include "passes/photons/photon_buffers.h"
#include "passes/specular/specular.h"

namespace voxilux {
namespace {

// The emitters, or the placeholder where only the sun sends photons.
std::string emitter_buffer(const RenderPlan& plan, std::string (*buffer)(const RenderPlan&, Recording&),
                           Recording& recording) {
    return plan.photons.emitter_photons != 0 ? buffer(plan, recording) : placeholder_buffer(recording);
}

}  // namespace

void record_photon_emit(const RenderPlan& plan, Recording& recording) {
    recording.dispatch(
        {.label = "photon.emit",
         .shader = "photon_emit",
         .extent = {plan.photons.at_once, 1, 1},
         .bindings = {{"Frame", frame_buffer(recording)},
                      {"PhotonFrame", photon_frame_buffer(recording)},
                      {"Spheres", spheres_buffer(plan, recording)},
                      {"Materials", materials_buffer(plan, recording)},
                      {"Lights", emitter_buffer(plan, lights_buffer, recording)},
                      {"LightTable", emitter_buffer(plan, light_table_buffer, recording)},
                      {"Starts", declare<gpu::PhotonStart>(recording, "photon.rays", plan.photons.at_once)}},
         .constants = surface_constants(plan)});
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
