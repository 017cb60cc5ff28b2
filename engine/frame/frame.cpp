#include "frame/frame.h"

#include <cmath>
#include <numbers>

#include "base/error.h"
#include "passes/ao.h"
#include "passes/aov.h"
#include "passes/film_add.h"
#include "passes/primary.h"
#include "passes/shade.h"
#include "passes/sphere.h"
#include "passes/sun.h"
#include "passes/upload.h"
#include "plan/film_planes.h"
#include "scene/scene_camera.h"
#include "shared/sampling.h"
#include "shared/sequence.h"

namespace voxilux {
namespace {

constexpr double kFarthestCamera = 8388608.0;  // 2^23 voxels: one ulp of a float there is a voxel

double radians(double degrees) {
    return degrees * std::numbers::pi / 180.0;
}

gpu::uint sequence_id(Sequence sequence) {
    switch (sequence) {
        case Sequence::sobol:
            return gpu::kSequenceSobol;
        case Sequence::halton:
            return gpu::kSequenceHalton;
        case Sequence::white:
            return gpu::kSequenceWhite;
    }
    VX_ASSERT(false);
}

void place_camera(gpu::FrameParams& params, const Camera& camera, glm::ivec3 origin, double aspect) {
    const glm::dvec3 local = camera.position - glm::dvec3(origin);
    const glm::dvec3 cell = glm::floor(local);
    for (int a = 0; a < 3; ++a) {
        if (!(std::abs(local[a]) < kFarthestCamera)) {
            throw Error(
                ExitCode::input_refused,
                fmt::format("camera position ({}, {}, {}) is over {} voxels from the scene",
                            camera.position.x, camera.position.y, camera.position.z, kFarthestCamera));
        }
    }
    params.camera_cell = glm::ivec3(cell);
    params.camera_fraction = glm::vec3(local - cell);
    const glm::dmat3 basis = camera_basis(camera);
    const double half_height = std::tan(radians(camera.fov_y_deg) / 2.0);
    params.camera_right = glm::vec3(basis[0] * half_height * aspect);
    params.camera_up = glm::vec3(basis[1] * half_height);
    params.camera_forward = glm::vec3(basis[2]);
}

// Half an axis of the image plane, such that its product with a vector in that plane is the image coordinate.
gpu::vec3 dual_axis(gpu::vec3 half_axis) {
    return half_axis / glm::dot(half_axis, half_axis);
}

gpu::AoParams ao_params(const RenderPlan& plan, const gpu::FrameParams& params, const SampleNumber& number) {
    const FrameState& state = number.state;
    const gpu::FrameParams& last = state.last_camera.value_or(params);
    const auto frame = static_cast<gpu::uint>(state.frames_done);  // wraps
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
            .cell_width = plan.settings.ao.cell_px * 2.0f * glm::length(params.camera_up) /
                          static_cast<float>(params.height)};
}

struct NumberedParams {
    const gpu::FrameParams& params;
    const SampleNumber& number;
};

AoStep ao_step(const RenderPlan& plan, NumberedParams now) {
    const FrameState& state = now.number.state;
    return {.params = ao_params(plan, now.params, now.number),
            .sweeps = now.number.sample == 0 && state.samples_done > 0 &&
                      is_sweep_frame(plan, state.frames_done, state.live_cells)};
}

Plane record_ao(const RenderPlan& plan, const Slice& slice, const Plane& hits, NumberedParams now,
                Recording& rec) {
    if (!plan.has_ao_cells()) return record_ao_trace(plan, slice, hits, rec);
    return record_ao_cells(plan, slice, hits, ao_step(plan, now), rec);
}

}  // namespace

gpu::FrameParams frame_params(const RenderPlan& plan, const Scene& scene, const MarchWorld& march_world) {
    const RenderSettings& settings = plan.settings;
    gpu::FrameParams params{};
    params.chunks = march_world.chunks_size;
    params.world_origin = march_world.origin;
    place_camera(params, camera_of(scene), march_world.origin,
                 static_cast<double>(plan.image_size.x) / static_cast<double>(plan.image_size.y));
    params.width = static_cast<gpu::uint>(plan.image_size.x);
    params.height = static_cast<gpu::uint>(plan.image_size.y);
    params.first_column = static_cast<gpu::uint>(plan.first_pixel.x);
    params.column_count = static_cast<gpu::uint>(settings.size.x);
    params.seed = settings.seed;
    params.sequence = sequence_id(settings.sequence);
    params.ao_rays = settings.ao_rays;
    params.ao_radius = settings.ao_radius;
    params.sky_radiance = plan.has(Effect::sky) ? scene.sky.radiance : glm::vec3(0.0f);
    params.sun_direction = scene.sun.direction();
    params.sun_irradiance = plan.has(Effect::sun) ? scene.sun.irradiance : glm::vec3(0.0f);
    params.sun_cone_height =
        gpu::cone_height(static_cast<float>(radians(scene.sun.angular_diameter_deg) / 2.0));
    params.sphere_count = plan.has(Effect::spheres) ? plan.sphere_count : 0;
    return params;
}

void record_frame(const RenderPlan& plan, const Slice& slice, gpu::FrameParams params,
                  const SampleNumber& number, Recording& rec) {
    const std::uint32_t sample = number.sample;
    const auto picture_row = static_cast<gpu::uint>(plan.first_pixel.y);
    params.first_row = picture_row + slice.first_row;
    params.row_count = slice.row_count;
    params.band_first_row = picture_row + slice.band_first_row;
    params.sample_index = sample;
    record_frame_upload(plan, params, rec);

    const Plane voxels = plan.has(Effect::voxels)
                             ? record_primary_march(plan, slice, record_primary_beam(plan, slice, rec), rec)
                             : constant_miss(rec);
    const Plane hits = plan.has(Effect::spheres) ? record_sphere_trace(plan, slice, voxels, rec) : voxels;
    const Plane ao = plan.has(Effect::ao) ? record_ao(plan, slice, hits, {params, number}, rec)
                                          : constant_value(1.0f, rec);
    const Plane sun =
        plan.has(Effect::sun) ? record_sun_trace(plan, slice, hits, rec) : constant_value(0.0f, rec);
    const Plane color = record_shade_resolve(plan, slice, {hits, ao, sun}, rec);
    record_film_add(plan, slice, {sample % 2 == 0 ? "beauty_a" : "beauty_b", 3}, color, rec);
    if (plan.sums_squares) record_film_square(plan, slice, {"squares", 3}, color, rec);

    if (!plan.has(Effect::aov)) return;
    const SurfacePlanes surface = record_aov_surface(plan, slice, hits, rec);
    record_film_add(plan, slice, {"albedo", 3}, surface.albedo, rec);
    record_film_add(plan, slice, {"normal", 3}, surface.normal, rec);
    if (plan.has(Effect::ao)) record_film_add(plan, slice, {"ao", 1}, ao, rec);
    if (plan.has(Effect::sun)) record_film_add(plan, slice, {"sun", 1}, sun, rec);
    if (sample == number.first) record_aov_position(plan, slice, hits, rec);
}

}  // namespace voxilux
