#include "passes/upload.h"

#include <algorithm>

#include "passes/photons/photon_trace.h"
#include "passes/plane.h"
#include "passes/sky/sky.h"
#include "passes/specular/rough_gains.h"
#include "passes/world.h"
#include "plan/film_planes.h"
#include "scene/lobe_weights.h"
#include "world/sphere_tree.h"

namespace voxilux {
namespace {

std::vector<gpu::SurfaceMaterial> surface_materials(const RenderPlan& plan, const Scene& scene) {
    std::vector<gpu::SurfaceMaterial> materials(plan.material_count);
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        const Material& material = scene.materials[i];
        const LobeWeights shares =
            plan.has(Effect::specular) ? lobe_weights(material, plan.shows_rough) : LobeWeights{};
        const float alpha = plan.shows_rough ? facet_alpha(material) : 0.0f;
        materials[i] = {.albedo = material.albedo,
                        .mirror = shares.mirror,
                        .emission = plan.has(Effect::emission) ? material.emission : glm::vec3(0.0f),
                        .glass = shares.glass,
                        .ior = material.ior,
                        .alpha = alpha,
                        .metal_row = gain_row_of(plan.gain_rows, {alpha, 0.0f}),
                        .glass_row = gain_row_of(plan.gain_rows, {alpha, material.ior})};
    }
    if (plan.has_ground) materials[scene.materials.size()].albedo = scene.ground.albedo;
    return materials;
}

// The gains of all rough materials, row by row.
std::vector<float> all_gains(const RenderPlan& plan) {
    std::vector<float> gains;
    for (const auto [alpha, eta] : plan.gain_rows) {
        const std::vector<float> row = rough_gains(alpha, eta);
        gains.insert(gains.end(), row.begin(), row.end());
    }
    return gains;
}

WorldBuffers build_buffers(const RenderPlan& plan, Recording& recording) {
    WorldBuffers buffers = world_buffers(plan, recording);
    const GrowthNeeds& growth = plan.world.growth;
    if (growth.levels.empty()) return buffers;
    buffers.homes = declare<std::byte>(recording, "world.homes", growth.home_bytes);
    buffers.grown = declare<std::byte>(recording, "world.grown", growth.grown_bytes);
    return buffers;
}

}  // namespace

void record_scene_upload(const RenderPlan& plan, const Scene& scene, const MarchWorld& march_world,
                         const LightList& lights, Recording& recording) {
    if (plan.has(Effect::voxels))
        record_world_build(march_world, plan.world.growth, build_buffers(plan, recording), recording);
    record_materials_upload(plan, scene, march_world.origin, lights, recording);
}

void record_materials_upload(const RenderPlan& plan, const Scene& scene, glm::ivec3 origin,
                             const LightList& lights, Recording& recording) {
    record_sky_build(plan, scene, recording);
    if (plan.has(Effect::spheres)) {
        const std::vector<gpu::SphereRecord> records = sphere_records(scene, origin);
        recording.upload(spheres_buffer(plan, recording), std::as_bytes(std::span(records)));
        if (plan.has_sphere_tree()) {
            const std::vector<gpu::SphereNode> tree = build_sphere_tree(records);
            recording.upload(sphere_tree_buffer(plan, recording), std::as_bytes(std::span(tree)));
        }
    }
    if (plan.has(Effect::voxels) || plan.has(Effect::spheres)) {
        const std::vector<gpu::SurfaceMaterial> materials = surface_materials(plan, scene);
        recording.upload(materials_buffer(plan, recording), std::as_bytes(std::span(materials)));
    }
    if (plan.shows_rough) {
        const std::vector<float> gains = all_gains(plan);
        recording.upload(gains_buffer(plan, recording), std::as_bytes(std::span(gains)));
    }
    record_photon_aims(plan, lights.aims, recording);
    const bool paths_aim = plan.paths.runs() && plan.has(Effect::emission) && plan.world.lights.count != 0;
    if (!plan.has(Effect::direct) && plan.photons.emitter_photons == 0 && !paths_aim) return;
    recording.upload(lights_buffer(plan, recording), std::as_bytes(std::span(lights.records)));
    recording.upload(light_table_buffer(plan, recording), std::as_bytes(std::span(lights.table)));
}

void record_frame_upload(const gpu::FrameParams& params, Recording& recording) {
    recording.upload(frame_buffer(recording), to_bytes(params));
    recording.clear(counters_buffer(recording));
}

void record_film_clear(const RenderPlan& plan, Recording& recording) {
    for (std::uint32_t film_tile = 0; film_tile < plan.film_tile_count; ++film_tile) {
        for (const FilmPlane& plane : film_planes(plan))
            recording.clear(film_plane<std::int64_t>(plan, plane, film_tile, recording));
        if (!plan.has(Effect::aov)) continue;
        recording.clear(film_plane<float>(plan, {"position", 3}, film_tile, recording));
        recording.clear(film_plane<float>(plan, {"depth", 1}, film_tile, recording));
    }
}

}  // namespace voxilux
