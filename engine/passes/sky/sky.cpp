#include "passes/sky/sky.h"

#include <algorithm>
#include <iterator>

#include "passes/sky/sky_image.h"
#include "scene/atmosphere.h"
#include "shared/sampling.h"
#include "shared/sky_bins.h"

namespace voxilux {
namespace {

// Whether anything looks the atmosphere up. Paths through the air that paths between surfaces end in do not.
bool needs_tables(const RenderPlan& plan) {
    return plan.has_atmosphere() && (!plan.traces_air() || !plan.paths.runs());
}

std::string view_buffer(const RenderPlan& plan, Recording& recording) {
    if (!needs_tables(plan)) return placeholder_buffer(recording);
    return declare<gpu::vec3>(recording, "sky.view",
                              std::uint64_t{gpu::kViewColours} * gpu::view_texels(plan.sky_resolution),
                              Lifetime::persistent);
}

// Rounds read one buffer and write the other.
void record_sky_scatter(const RenderPlan& plan, const gpu::Air& air, Recording& recording) {
    static_assert(gpu::kScatterRounds % 2 == 0);  // so that the last one writes "sky.scatter"
    std::string read = declare<gpu::uvec4>(recording, "sky.next_scatter", gpu::kScatterPairs);
    std::string write = scatter_buffer(plan, recording);
    recording.clear(read);
    for (gpu::uint round = 0; round <= gpu::kScatterRounds; ++round) {
        recording.dispatch({.label = "sky.scatter",
                            .shader = "sky_scatter",
                            .extent = {gpu::kScatterTexels, 1, 1},
                            .bindings = {{"Scatter", read}, {"NextScatter", write}},
                            .push = to_bytes(gpu::SkyScatterPush{air, round == 0 ? 1u : 0u})});
        std::swap(read, write);
    }
}

std::string shares_buffer(const RenderPlan& plan, Recording& recording) {
    if (!plan.has_atmosphere()) return placeholder_buffer(recording);
    return declare<float>(recording, "sky.shares", gpu::kSkyShares, Lifetime::persistent);
}

// Builds the distributions from which sky.trace draws directions.
void record_sky_shares(const RenderPlan& plan, Recording& recording) {
    const std::string bins = declare<float>(recording, "sky.bins", gpu::kSkyBins * gpu::kSkyBins);
    const std::string rows = declare<float>(recording, "sky.rows", gpu::kFaceCount * gpu::kSkyBins);
    const std::string shares = shares_buffer(plan, recording);
    recording.dispatch({.label = "sky.bins",
                        .shader = "sky_bins",
                        .extent = {gpu::kSkyBins * gpu::kSkyBins, 1, 1},
                        .bindings = {{"Sky", sky_params_buffer(recording)},
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
                        .bindings = {{"Sky", sky_params_buffer(recording)},
                                     {"SkyView", view_buffer(plan, recording)},
                                     {"SkyFaces", sky_faces_buffer(plan, recording)}}});
}

// Of the passes that see the sky.
std::vector<Constant> seen_constants(const RenderPlan& plan) {
    std::vector<Constant> constants{{"misses_have_direction", plan.has(Effect::specular) ? 1u : 0u},
                                    {"traces_air", plan.traces_air() ? 1u : 0u}};
    std::ranges::copy(sky_image_constants(plan), std::back_inserter(constants));
    return constants;
}

}  // namespace

std::string sky_params_buffer(Recording& recording) {
    return declare<gpu::SkyParams>(recording, "sky.params", 1, Lifetime::persistent);
}

std::string scatter_buffer(const RenderPlan& plan, Recording& recording) {
    if (!needs_tables(plan)) return placeholder_buffer(recording);
    const Lifetime lifetime = plan.has_aerial() ? Lifetime::persistent : Lifetime::transient;
    return declare<gpu::uvec4>(recording, "sky.scatter", gpu::kScatterPairs, lifetime);
}

std::string sky_faces_buffer(const RenderPlan& plan, Recording& recording) {
    const bool is_read = plan.has_sky_image() ? !plan.paths.runs() : needs_tables(plan);
    if (!is_read) return placeholder_buffer(recording);
    return declare<gpu::vec3>(recording, "sky.faces", gpu::kFaceCount, Lifetime::persistent);
}

std::vector<Binding> sky_bindings(const RenderPlan& plan, Recording& recording) {
    return {{"Sky", plan.has_atmosphere() ? sky_params_buffer(recording) : constant_sky_buffer(recording)},
            {"SkyView", view_buffer(plan, recording)},
            {"SkyTexels", sky_texels_buffer(plan, recording)}};
}

void record_sky_build(const RenderPlan& plan, const Scene& scene, Recording& recording) {
    record_sky_image(plan, scene.sky, recording);
    if (!plan.has_atmosphere()) return;
    gpu::SkyParams sky = sky_params(scene);
    sky.resolution = plan.sky_resolution;
    recording.upload(sky_params_buffer(recording), to_bytes(sky));
    if (!needs_tables(plan)) return;
    record_sky_scatter(plan, sky.air, recording);
    recording.dispatch({.label = "sky.view",
                        .shader = "sky_view",
                        .extent = {gpu::view_texels(plan.sky_resolution), 1, 1},
                        .bindings = {{"Scatter", scatter_buffer(plan, recording)},
                                     {"SkyView", view_buffer(plan, recording)}},
                        .push = to_bytes(sky)});
    if (traces_sky(plan)) {
        record_sky_shares(plan, recording);
    } else {
        record_sky_faces(plan, recording);
    }
}

bool traces_sky(const RenderPlan& plan) {
    return plan.has_sky_plane() && plan.has(Effect::ao) && !plan.ao.uses_cells() && !plan.paths.runs();
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
                                   {"SkyShares", shares_buffer(plan, recording)},
                                   {"SkyTable", sky_table_buffer(plan, recording)},
                                   {"Hits", hits.buffer},
                                   {"Ao", planes.ao.buffer},
                                   {"SkyLight", planes.light.buffer}},
                      .constants = surface_constants(plan)};
    std::ranges::copy(sky_bindings(plan, recording), std::back_inserter(dispatch.bindings));
    dispatch.constants.push_back({"hits_stride", hits.stride});
    dispatch.constants.push_back({"ao_rays", plan.settings.ao_rays});
    std::ranges::copy(seen_constants(plan), std::back_inserter(dispatch.constants));
    point_to_world(plan.world.traversal, world_buffers(plan, recording), dispatch);
    recording.dispatch(std::move(dispatch));
    return planes;
}

Plane record_sky_resolve(const RenderPlan& plan, const DispatchTile& tile, const Plane& hits, const Plane& ao,
                         Recording& recording) {
    const Plane light{declare_plane<gpu::vec3>(plan, "sky.light", recording)};
    std::vector<Constant> constants{sequence_constant(plan),
                                    projection_constant(plan),
                                    {"sphere_count", plan.has(Effect::spheres) ? plan.sphere_count : 0u},
                                    {"hits_stride", hits.stride},
                                    {"ao_stride", ao.stride},
                                    {"paths_find_sky", plan.paths.runs() ? 1u : 0u}};
    std::ranges::copy(seen_constants(plan), std::back_inserter(constants));
    std::vector<Binding> bindings = sky_bindings(plan, recording);
    bindings.insert(bindings.end(), {{"Frame", frame_buffer(recording)},
                                     {"Spheres", spheres_buffer(plan, recording)},
                                     {"SkyFaces", sky_faces_buffer(plan, recording)},
                                     {"Hits", hits.buffer},
                                     {"Ao", ao.buffer},
                                     {"SkyLight", light.buffer}});
    recording.dispatch({.label = "sky.resolve",
                        .shader = "sky_resolve",
                        .extent = pixel_extent(plan, tile),
                        .bindings = std::move(bindings),
                        .constants = std::move(constants)});
    return light;
}

}  // namespace voxilux
