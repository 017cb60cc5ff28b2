#include "frame/frame.h"

#include "passes/aerial/aerial.h"
#include "passes/ao/ao.h"
#include "passes/film/aov.h"
#include "passes/film/film_add.h"
#include "passes/light/direct.h"
#include "passes/light/sun.h"
#include "passes/paths/paths.h"
#include "passes/photons/photons.h"
#include "passes/primary/primary.h"
#include "passes/primary/sphere.h"
#include "passes/sky/sky.h"
#include "passes/specular/specular.h"
#include "passes/upload.h"
#include "plan/film_planes.h"
#include "shared/hash.h"
#include "shared/projection.h"

namespace voxilux {
namespace {

// Each half of the film follows a sequence of its own, scrambled independently. The halves are therefore
// replicates, and their difference tells the error of their mean (P. L'Ecuyer and C. Lemieux, "Recent
// Advances in Randomized Quasi-Monte Carlo Methods", 2002). Every other point of one sequence would not do:
// such halves fill each other's gaps and differ by far more than the error of their mean. Occlusion cells
// have sequences of their own, and no halves.
void number_sample(const RenderPlan& plan, std::uint32_t sample, gpu::FrameParams& params) {
    const bool halves = !plan.any(&Technique::shares_samples);
    params.sample_index = halves ? sample / 2 : sample;
    if (halves && sample % 2 == 1) params.seed = gpu::pcg_hash(params.seed);
}

// The dual of half an axis of the image plane: its dot product with a vector in that plane is the image
// coordinate.
gpu::vec3 dual_axis(gpu::vec3 half_axis) {
    return half_axis / glm::dot(half_axis, half_axis);
}

// Desired width of an occlusion cell at distance 1; for a camera with parallel rays, at any distance.
float wanted_cell_width(const RenderPlan& plan, const gpu::FrameParams& params) {
    const float cell_px = plan.settings.ao.cell_px;
    if (plan.projection == Projection::perspective)
        return cell_px * 2.0f * glm::length(params.camera_up) / static_cast<float>(params.height);
    return cell_px * gpu::pixel_width(params, static_cast<gpu::uint>(plan.projection));
}

gpu::AoParams ao_params(const RenderPlan& plan, const gpu::FrameParams& params, const SampleNumber& number) {
    const FrameState& state = number.state;
    const gpu::FrameParams& last = state.last_camera.value_or(params);
    const auto frame = static_cast<gpu::uint>(state.frames_done);  // wraps
    const bool is_parallel = plan.projection == Projection::orthographic;
    const float width = wanted_cell_width(plan, params);
    return {.last_camera_cell = last.camera_cell,
            .last_camera_fraction = last.camera_fraction,
            .last_right = dual_axis(last.camera_right),
            .last_up = dual_axis(last.camera_up),
            .last_forward = last.camera_forward,
            .has_last = state.last_camera ? 1u : 0u,
            .frame = frame,
            .pass_number = static_cast<gpu::uint>(state.samples_done),
            .table_mask = plan.ao.slots - 1,
            .max_age = cell_age(plan, state.live_cells),
            .sample_limit = plan.settings.ao.sample_limit,
            .cell_width = is_parallel ? 0.0f : width,
            .parallel_width = is_parallel ? width : 0.0f};
}

AoStep ao_step(const RenderPlan& plan, const gpu::FrameParams& params, const SampleNumber& number) {
    const FrameState& state = number.state;
    return {.params = ao_params(plan, params, number),
            .sweeps = number.sample == 0 && state.samples_done > 0 &&
                      is_sweep_frame(plan, state.frames_done, state.live_cells)};
}

// The light of a constant sky is a parameter of the frame, and only its occlusion is a plane.
SkyPlanes record_sky(const RenderPlan& plan, const DispatchTile& tile, const Plane& hits, const AoStep& step,
                     Recording& rec) {
    if (traces_sky(plan)) return record_sky_trace(plan, tile, hits, rec);
    const Plane ao =
        plan.has(Effect::ao) ? record_ao(plan, tile, hits, step, rec) : constant_value(1.0f, rec);
    if (plan.has_sky_plane()) {
        const Plane seen = plan.paths.runs() ? constant_value(0.0f, rec) : ao;  // paths find it at surfaces
        return {record_sky_resolve(plan, tile, hits, seen, rec), ao};
    }
    return {constant_value(0.0f, rec), ao};
}

}  // namespace

void record_frame(const RenderPlan& plan, const DispatchTile& tile, gpu::FrameParams params,
                  const SampleNumber& number, Recording& rec) {
    const std::uint32_t sample = number.sample;
    const auto picture_row = static_cast<gpu::uint>(plan.first_pixel.y);
    params.first_row = picture_row + tile.first_row;
    params.row_count = tile.row_count;
    params.film_tile_first_row = picture_row + tile.film_tile_first_row;
    params.first_element =
        params.column_count * (tile.first_row - tile.film_tile_first_row) % gpu::kGroupPixels;
    number_sample(plan, sample, params);
    record_frame_upload(params, rec);

    const Plane voxels = plan.has(Effect::voxels)
                             ? record_primary_march(plan, tile, record_primary_beam(plan, tile, rec), rec)
                             : constant_miss(rec);
    const Plane hits = plan.has(Effect::spheres) ? record_sphere_trace(plan, tile, voxels, rec) : voxels;
    const SpecularPlanes seen = plan.has(Effect::specular) ? record_specular_trace(plan, tile, hits, rec)
                                                           : SpecularPlanes{hits, constant_value(1.0f, rec)};
    const AerialPlanes air = plan.has_aerial()
                                 ? record_aerial_trace(plan, tile, hits, seen.weights, rec)
                                 : AerialPlanes{.weights = seen.weights, .light = constant_value(0.0f, rec)};
    const SkyPlanes sky = record_sky(plan, tile, seen.hits, ao_step(plan, params, number), rec);
    const Plane sun =
        plan.has(Effect::sun) ? record_sun_trace(plan, tile, seen.hits, rec) : constant_value(0.0f, rec);
    const Plane direct = plan.has(Effect::direct) ? record_direct_trace(plan, tile, seen.hits, rec)
                                                  : constant_value(0.0f, rec);
    const Plane sent = plan.paths.runs() ? record_paths(plan, tile, seen.hits, direct, rec) : direct;
    const PhotonPlanes photons = record_photons(plan, tile, seen.hits, sample + 1, rec);
    const FilmInputs inputs{.first_hits = hits,
                            .seen = {seen.hits, air.weights},
                            .ao = sky.ao,
                            .sky = sky.light,
                            .air = air.light,
                            .sun = sun,
                            .direct = sent,
                            .photons = photons};
    record_film_add(plan, tile, inputs, sample, number.keeps_color, rec);
    if (plan.sums_guides) record_denoise_guide(plan, tile, inputs, sample, rec);
    if (plan.has(Effect::aov) && sample == number.first) record_aov_position(plan, tile, hits, rec);
}

}  // namespace voxilux
