#include "passes/upload.h"

#include <algorithm>

#include "passes/plane.h"
#include "passes/world.h"
#include "plan/film_planes.h"
#include "scene/surface_shares.h"

namespace voxilux {
namespace {

template <class T>
void upload_all(const RenderPlan& plan, const std::string& name, const std::vector<T>& values,
                Recording& recording) {
    recording.upload(use_buffer(plan, name, recording), std::as_bytes(std::span(values)));
}

std::vector<gpu::SurfaceMaterial> surface_materials(const RenderPlan& plan, const Scene& scene) {
    std::vector<gpu::SurfaceMaterial> materials(plan.material_count);
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        const Material& material = scene.materials[i];
        const SurfaceShares shares = plan.has(Effect::specular) ? surface_shares(material) : SurfaceShares{};
        materials[i] = {.albedo = material.albedo,
                        .emission = plan.has(Effect::emission) ? material.emission : glm::vec3(0.0f),
                        .mirror = shares.mirror,
                        .glass = shares.glass,
                        .ior = material.ior};
    }
    return materials;
}

// The sphere by its point nearest to the world's corner, in double until it is small.
gpu::SphereRecord sphere_record(const Sphere& sphere, glm::ivec3 origin) {
    const glm::dvec3 centre = sphere.centre - glm::dvec3(origin);
    const double distance = glm::length(centre);
    const glm::dvec3 normal = distance > 0.0 ? -centre / distance : glm::dvec3(0.0, 0.0, 1.0);
    const gpu::Sphere shape{glm::vec3(centre + sphere.radius * normal),
                            static_cast<float>(1.0 / sphere.radius), glm::vec3(normal)};
    return {shape, sphere.material};
}

WorldBuffers build_buffers(const RenderPlan& plan, Recording& recording) {
    WorldBuffers buffers = world_buffers(plan, recording);
    if (plan.world.growth.steps == 0) return buffers;
    buffers.homes = use_buffer(plan, "world.homes", recording);
    buffers.grown = use_buffer(plan, "world.grown", recording);
    return buffers;
}

}  // namespace

void record_scene_upload(const RenderPlan& plan, const Scene& scene, const MarchWorld& march_world,
                         const LightList& lights, Recording& recording) {
    if (plan.has(Effect::voxels)) record_world_build(march_world, build_buffers(plan, recording), recording);
    record_matter_upload(plan, scene, march_world.origin, lights, recording);
}

void record_matter_upload(const RenderPlan& plan, const Scene& scene, glm::ivec3 origin,
                          const LightList& lights, Recording& recording) {
    if (plan.has(Effect::spheres)) {
        std::vector<gpu::SphereRecord> records;
        for (const std::uint32_t number : sphere_order(scene))
            records.push_back(sphere_record(scene.spheres[number], origin));
        upload_all(plan, "sphere.records", records, recording);
    }
    if (plan.has(Effect::voxels) || plan.has(Effect::spheres))
        upload_all(plan, "materials", surface_materials(plan, scene), recording);
    if (!plan.has(Effect::direct) && plan.photons.lamp_photons == 0) return;
    upload_all(plan, "light.records", lights.records, recording);
    upload_all(plan, "light.table", lights.table, recording);
}

void record_frame_upload(const RenderPlan& plan, const gpu::FrameParams& params, Recording& recording) {
    recording.upload(use_buffer(plan, "frame", recording), to_bytes(params));
    recording.clear(use_buffer(plan, "tally", recording));
}

void record_film_clear(const RenderPlan& plan, Recording& recording) {
    for (std::uint32_t band = 0; band < plan.band_count; ++band) {
        for (const FilmPlane& plane : film_planes(plan))
            recording.clear(use_buffer(plan, film_buffer(plane.name, band), recording));
        if (!plan.has(Effect::aov)) continue;
        recording.clear(use_buffer(plan, film_buffer("position", band), recording));
        recording.clear(use_buffer(plan, film_buffer("depth", band), recording));
    }
}

}  // namespace voxilux
