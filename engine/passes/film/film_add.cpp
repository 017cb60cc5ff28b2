#include "passes/film/film_add.h"

#include <algorithm>

#include "shared/gpu_types.h"

namespace voxilux {
namespace {

// Binds the sums of a plane, or the placeholder where the plan has none.
void bind_sums(const RenderPlan& plan, const DispatchTile& tile, const std::string& block,
               const std::string& name, Dispatch& dispatch, Recording& recording) {
    const std::vector<FilmPlane> planes = film_planes(plan);
    const auto plane = std::ranges::find(planes, name, &FilmPlane::name);
    const std::string sums = plane == planes.end()
                                 ? placeholder_buffer(recording)
                                 : film_plane<std::int64_t>(plan, *plane, tile.film_tile, recording);
    dispatch.bindings.push_back({block, sums});
    dispatch.bindings.push_back({block + "Words", sums});
}

std::uint32_t tile_width(const RenderPlan& plan) {
    return static_cast<std::uint32_t>(plan.settings.size.x);
}

gpu::FilmAddPush pixels_of(const RenderPlan& plan, const DispatchTile& tile) {
    return {.first_pixel = tile_width(plan) * (tile.first_row - tile.film_tile_first_row),
            .pixel_count = tile_width(plan) * tile.row_count};
}

// Constants of the passes that shade.
std::vector<Constant> shading_constants(const RenderPlan& plan, const FilmInputs& inputs) {
    return {{"hits_stride", inputs.seen.hits.stride},
            {"weights_stride", inputs.seen.weights.stride},
            {"aerial_stride", inputs.air.stride},
            {"ao_stride", inputs.ao.stride},
            {"sky_stride", inputs.sky.stride},
            {"paths_find_sky", plan.paths.runs() ? 1u : 0u},
            {"sun_stride", inputs.sun.stride},
            {"direct_stride", inputs.direct.stride},
            {"photons_stride", inputs.photons.light.stride},
            {"sphere_count", plan.has(Effect::spheres) ? 1u : 0u},  // any or none: fewer shader variants
            {"has_emission", plan.has(Effect::emission) ? 1u : 0u},
            {"has_specular", plan.has(Effect::specular) ? 1u : 0u},
            {"sums_coverage", plan.sums_coverage ? 1u : 0u},
            {"catches_shadows", plan.catches_shadows ? 1u : 0u}};
}

std::vector<Constant> sum_constants(const RenderPlan& plan, bool keeps_color) {
    const bool has_aov = plan.has(Effect::aov);
    return {{"sums_squares", plan.sums_squares ? 1u : 0u},
            {"sums_bias", plan.sums_bias ? 1u : 0u},
            {"sums_surface", has_aov ? 1u : 0u},
            {"sums_ao", has_aov && plan.has(Effect::ao) ? 1u : 0u},
            {"sums_sun", has_aov && plan.has(Effect::sun) ? 1u : 0u},
            {"keeps_color", keeps_color ? 1u : 0u}};
}

// What the passes that shade have in common.
Dispatch shading_dispatch(const RenderPlan& plan, const DispatchTile& tile, const FilmInputs& inputs,
                          Recording& recording) {
    const gpu::FilmAddPush push = pixels_of(plan, tile);
    const std::uint64_t pixels = push.first_pixel % gpu::kGroupPixels + push.pixel_count;
    return {.extent = {static_cast<std::uint32_t>(plane_elements(pixels) / gpu::kGroupPixels), 1, 1},
            .bindings = {{"Frame", frame_buffer(recording)},
                         {"Counters", counters_buffer(recording)},
                         {"Spheres", spheres_buffer(plan, recording)},
                         {"Materials", materials_buffer(plan, recording)},
                         {"FirstHits", inputs.first_hits.buffer},
                         {"Hits", inputs.seen.hits.buffer},
                         {"Weights", inputs.seen.weights.buffer},
                         {"AerialLight", inputs.air.buffer},
                         {"Ao", inputs.ao.buffer},
                         {"SkyLight", inputs.sky.buffer},
                         {"Sun", inputs.sun.buffer},
                         {"Direct", inputs.direct.buffer},
                         {"Photons", inputs.photons.light.buffer}},
            .constants = shading_constants(plan, inputs),
            .push = to_bytes(push)};
}

const char* half_of(std::uint32_t sample) {
    return sample % 2 == 0 ? "_a" : "_b";
}

}  // namespace

void record_denoise_guide(const RenderPlan& plan, const DispatchTile& tile, const FilmInputs& inputs,
                          std::uint32_t sample, Recording& recording) {
    Dispatch dispatch = shading_dispatch(plan, tile, inputs, recording);
    dispatch.label = "denoise.guide";
    dispatch.shader = "denoise_guide";
    dispatch.constants.push_back({"has_rough", plan.shows_rough ? 1u : 0u});
    const std::string half = half_of(sample);
    for (const auto& [block, name] : {std::pair<const char*, std::string>{"GuideSharp", "guide_sharp" + half},
                                      {"GuideAlbedo", "guide_albedo" + half},
                                      {"GuideNormal", "guide_normal" + half},
                                      {"GuideOffset", "guide_offset" + half}})
        bind_sums(plan, tile, block, name, dispatch, recording);
    recording.dispatch(std::move(dispatch));
}

void record_film_add(const RenderPlan& plan, const DispatchTile& tile, const FilmInputs& inputs,
                     std::uint32_t sample, bool keeps_color, Recording& recording) {
    Dispatch dispatch = shading_dispatch(plan, tile, inputs, recording);
    dispatch.label = "film.add";
    dispatch.shader = "film_add";
    const std::vector<Constant> of_sums = sum_constants(plan, keeps_color);
    dispatch.constants.insert(dispatch.constants.end(), of_sums.begin(), of_sums.end());
    dispatch.bindings.push_back({"HalfAreaPhotons", inputs.photons.half_area.buffer});
    dispatch.bindings.push_back({"Color", keeps_color
                                              ? declare_plane<gpu::vec3>(plan, "film.color", recording)
                                              : placeholder_buffer(recording)});
    const std::string half = half_of(sample);
    for (const auto& [block, name] : {std::pair<const char*, std::string>{"Beauty", "beauty" + half},
                                      {"Squares", "squares"},
                                      {"Bias", "bias" + half},
                                      {"Coverage", "coverage"},
                                      {"Albedo", "albedo"},
                                      {"Normal", "normal"},
                                      {"AoSums", "ao"},
                                      {"SunSums", "sun"}})
        bind_sums(plan, tile, block, name, dispatch, recording);
    recording.dispatch(std::move(dispatch));
}

}  // namespace voxilux
