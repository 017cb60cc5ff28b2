#include "passes/sky/sky.h"

#include "scene/atmosphere.h"
#include "shared/sampling.h"
#include "shared/sky_bins.h"

namespace voxilux {
namespace {

std::string params_buffer(Recording& recording) {
    return declare<gpu::SkyParams>(recording, "sky.params", 1, Lifetime::persistent);
}

std::string view_buffer(const RenderPlan& plan, Recording& recording) {
    return declare<gpu::vec3>(recording, "sky.view",
                              std::uint64_t{gpu::kViewColours} * gpu::view_texels(plan.sky_resolution),
                              Lifetime::persistent);
}

std::string faces_buffer(Recording& recording) {
    return declare<gpu::vec3>(recording, "sky.faces", gpu::kFaceCount, Lifetime::persistent);
}

// Rounds read one buffer and write the other. Returns the name of the last one written.
std::string record_sky_scatter(const gpu::Air& air, Recording& recording) {
    std::string read = declare<gpu::uint>(recording, "sky.scatter", gpu::kScatterWords);
    std::string write = declare<gpu::uint>(recording, "sky.next_scatter", gpu::kScatterWords);
    recording.clear(read);
    for (gpu::uint round = 0; round <= gpu::kScatterRounds; ++round) {
        recording.dispatch({.label = "sky.scatter",
                            .shader = "sky_scatter",
                            .extent = {gpu::kScatterTexels, 1, 1},
                            .bindings = {{"Scatter", read}, {"NextScatter", write}},
                            .push = to_bytes(gpu::SkyScatterPush{air, round == 0 ? 1u : 0u})});
        std::swap(read, write);
    }
    return read;
}

std::string shares_buffer(Recording& recording) {
    return declare<float>(recording, "sky.shares", gpu::kSkyShares, Lifetime::persistent);
}

// Builds the distributions from which sky.trace draws directions.
void record_sky_shares(const RenderPlan& plan, Recording& recording) {
    const std::string bins = declare<float>(recording, "sky.bins", gpu::kSkyBins * gpu::kSkyBins);
    const std::string rows = declare<float>(recording, "sky.rows", gpu::kFaceCount * gpu::kSkyBins);
    const std::string shares = shares_buffer(recording);
    recording.dispatch({.label = "sky.bins",
                        .shader = "sky_bins",
                        .extent = {gpu::kSkyBins * gpu::kSkyBins, 1, 1},
                        .bindings = {{"Sky", params_buffer(recording)},
                                     {"SkyView", view_buffer(plan, recording)},
                                     {"SkyBins", bins}}});
    recording.dispatch({.label = "sky.columns",
                        .shader = "sky_columns",
                        .extent = {gpu::kFaceCount * gpu::kSkyBins, 1, 1},
                        .bindings = {{"SkyBins", bins}, {"SkyRows", rows}, {"SkyShares", shares}}});
    recording.dispatch({.label = "sky.rows",
                        .shader = "sky_rows",
                        .extent = {gpu::kFaceCount, 1, 1},
                        .bindings = {{"SkyRows", rows}, {"SkyShares", shares}}});
}

// Integrates the light of the whole sky, for techniques that find visibility separately.
void record_sky_faces(const RenderPlan& plan, Recording& recording) {
    recording.dispatch({.label = "sky.faces",
                        .shader = "sky_faces",
                        .extent = {gpu::kFaceCount, 1, 1},
                        .bindings = {{"Sky", params_buffer(recording)},
                                     {"SkyView", view_buffer(plan, recording)},
                                     {"SkyFaces", faces_buffer(recording)}}});
}

Constant direction_constant(const RenderPlan& plan) {
    return {"misses_have_direction", plan.has(Effect::specular) ? 1u : 0u};
}

}  // namespace

std::vector<Binding> sky_bindings(const RenderPlan& plan, Recording& recording) {
    if (!plan.has_atmosphere())
        return {{"Sky", constant_sky_buffer(recording)}, {"SkyView", placeholder_buffer(recording)}};
    return {{"Sky", params_buffer(recording)}, {"SkyView", view_buffer(plan, recording)}};
}

void record_sky_build(const RenderPlan& plan, const Scene& scene, Recording& recording) {
    if (!plan.has_atmosphere()) return;
    gpu::SkyParams sky = sky_params(scene);
    sky.resolution = plan.sky_resolution;
    recording.upload(params_buffer(recording), to_bytes(sky));
    const std::string scatter = record_sky_scatter(sky.air, recording);
    recording.dispatch({.label = "sky.view",
                        .shader = "sky_view",
                        .extent = {gpu::view_texels(plan.sky_resolution), 1, 1},
                        .bindings = {{"Scatter", scatter}, {"SkyView", view_buffer(plan, recording)}},
                        .push = to_bytes(sky)});
    if (traces_sky(plan)) {
        record_sky_shares(plan, recording);
    } else {
        record_sky_faces(plan, recording);
    }
}

bool traces_sky(const RenderPlan& plan) {
    return plan.has_atmosphere() && plan.has(Effect::ao) && !plan.ao.uses_cells() && !plan.paths.runs();
}

SkyPlanes record_sky_trace(const RenderPlan& plan, const DispatchTile& tile, const Plane& hits,
                           Recording& recording) {
    const SkyPlanes planes{.light = {declare_plane<gpu::vec3>(plan, "sky.light", recording)},
                           .ao = {declare_plane<float>(plan, "ao.visibility", recording)}};
    Dispatch dispatch{.label = "sky.trace",
                      .shader = "sky_trace",
                      .extent = pixel_extent(plan, tile),
                      .bindings = {{"Frame", frame_buffer(recording)},
                                   {"Counters", counters_buffer(recording)},
                                   {"Spheres", spheres_buffer(plan, recording)},
                                   {"SphereTable", sphere_table_buffer(plan, recording)},
                                   {"SphereTree", sphere_tree_buffer(plan, recording)},
                                   {"Sky", params_buffer(recording)},
                                   {"SkyView", view_buffer(plan, recording)},
                                   {"SkyShares", shares_buffer(recording)},
                                   {"Hits", hits.buffer},
                                   {"Ao", planes.ao.buffer},
                                   {"SkyLight", planes.light.buffer}},
                      .constants = surface_constants(plan)};
    dispatch.constants.push_back({"hits_stride", hits.stride});
    dispatch.constants.push_back({"ao_rays", plan.settings.ao_rays});
    dispatch.constants.push_back(direction_constant(plan));
    point_to_world(plan.world.traversal, world_buffers(plan, recording), dispatch);
    recording.dispatch(std::move(dispatch));
    return planes;
}

Plane record_sky_resolve(const RenderPlan& plan, const DispatchTile& tile, const Plane& hits, const Plane& ao,
                         Recording& recording) {
    const Plane light{declare_plane<gpu::vec3>(plan, "sky.light", recording)};
    recording.dispatch({.label = "sky.resolve",
                        .shader = "sky_resolve",
                        .extent = pixel_extent(plan, tile),
                        .bindings = {{"Frame", frame_buffer(recording)},
                                     {"Spheres", spheres_buffer(plan, recording)},
                                     {"Sky", params_buffer(recording)},
                                     {"SkyView", view_buffer(plan, recording)},
                                     {"SkyFaces", faces_buffer(recording)},
                                     {"Hits", hits.buffer},
                                     {"Ao", ao.buffer},
                                     {"SkyLight", light.buffer}},
                        .constants = {sequence_constant(plan),
                                      projection_constant(plan),
                                      {"sphere_count", plan.has(Effect::spheres) ? plan.sphere_count : 0u},
                                      {"hits_stride", hits.stride},
                                      {"ao_stride", ao.stride},
                                      direction_constant(plan)}});
    return light;
}

}  // namespace voxilux
