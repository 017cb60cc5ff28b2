#include <cmath>
#include <numbers>

#include "base/error.h"
#include "frame/frame.h"
#include "scene/atmosphere.h"
#include "scene/scene_camera.h"
#include "shared/sampling.h"
#include "shared/sequence.h"

namespace voxilux {
namespace {

constexpr double kFarthestCamera = 8388608.0;  // 2^23 voxels: one ulp of a float there is a voxel

double radians(double degrees) {
    return degrees * std::numbers::pi / 180.0;
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

void place_lights(gpu::FrameParams& params, const RenderPlan& plan) {
    params.light_count = plan.world.lights.count;
    params.light_power = static_cast<float>(plan.world.lights.power);
    params.emitter_photons = plan.photons.emitter_photons;
    params.sun_photons = plan.photons.sun_photons;
    params.sun_disc_centre = glm::vec3(plan.world.lights.sun_disc.centre);
    params.sun_disc_radius = static_cast<float>(plan.world.lights.sun_disc.radius);
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
    params.ao_radius = settings.ao_radius;
    params.sky_radiance =
        plan.has(Effect::sky) && !plan.has_atmosphere() ? scene.sky.radiance : glm::vec3(0.0f);
    params.sun_direction = scene.sun.direction();
    params.sun_irradiance = plan.has(Effect::sun) ? sunlight(scene) : glm::vec3(0.0f);
    params.sun_cone_height =
        gpu::cone_height(static_cast<float>(radians(scene.sun.angular_diameter_deg) / 2.0));
    place_lights(params, plan);
    return params;
}

}  // namespace voxilux
