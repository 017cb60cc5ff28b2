#include "scene/atmosphere.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "shared/sampling.h"

namespace voxilux {
namespace {

constexpr float kKilometre = 1000.0f;  // metres

// Hillaire 2020, table 1 and reference code: per km, for 680, 550 and 440 nm.
gpu::Air air_of(const Sky& sky) {
    constexpr float kMieScattering = 3.996e-3f, kMieAbsorption = 0.444e-3f;
    return {.rayleigh = sky.rayleigh * glm::vec3(5.802e-3f, 13.558e-3f, 33.1e-3f),
            .ozone = sky.ozone * glm::vec3(0.65e-3f, 1.881e-3f, 0.085e-3f),
            .mie = sky.mie * kMieScattering,
            .mie_extinction = sky.mie * (kMieScattering + kMieAbsorption),
            .mie_g = sky.mie_g,
            .ground_albedo = sky.ground_albedo};
}

float disc_height(const Sun& sun) {
    return gpu::cone_height(sun.angular_diameter_deg * (std::numbers::pi_v<float> / 360.0f));
}

// The mean transmittance over the sun's disc. It depends on the elevation alone, so the disc is cut into
// slices of equal height, each weighted by its chord.
glm::vec3 disc_transmittance(const gpu::SkyParams& sky, float radius) {
    constexpr int kSlices = 64;
    const float elevation = std::asin(std::clamp(sky.sun_direction.z, -1.0f, 1.0f));
    glm::vec3 sum(0.0f);
    float chords = 0.0f;
    for (int i = 0; i < kSlices; ++i) {
        const float y = (2.0f * static_cast<float>(i) + 1.0f) / kSlices - 1.0f;
        const float chord = std::sqrt(1.0f - y * y);
        const float slice = std::min(elevation + y * radius, std::numbers::pi_v<float> / 2.0f);
        sum += chord * gpu::transmittance_out(sky.air, sky.height, std::sin(slice));
        chords += chord;
    }
    return sum / chords;
}

// From the camera, voxels; without one, as far as a camera is that sees all of the scene.
double farthest_surface(const Scene& scene, const Box& voxels) {
    if (scene.ground.on) return double{gpu::kFarthestGround};
    const Box box = united(sphere_bounds(scene.spheres), voxels);
    if (box.empty()) return 0.0;
    const glm::dvec3 lo(box.lo), hi(box.hi);
    if (!scene.camera) return 2.0 * glm::length(hi - lo);
    const glm::dvec3 eye = scene.camera->position;
    return glm::length(glm::max(glm::abs(eye - lo), glm::abs(eye - hi)));
}

}  // namespace

gpu::SkyParams sky_params(const Scene& scene) {
    const Sky& sky = scene.sky;
    const float height = sky.altitude_m / kKilometre;
    return {.air = air_of(sky),
            .height = height,
            .horizon = gpu::horizon_elevation(height),
            .top = height > gpu::kAirTop ? gpu::tangent_elevation(height, height - gpu::kAirTop)
                                         : std::numbers::pi_v<float> / 2.0f,
            .disc_height = disc_height(scene.sun),
            .sun_direction = scene.sun.direction(),
            .irradiance = scene.sun.on ? scene.sun.irradiance : glm::vec3(0.0f),
            .resolution = sky.resolution,
            .km_per_voxel = sky.metres_per_voxel / kKilometre};
}

glm::vec3 sunlight(const Scene& scene) {
    const Sun& sun = scene.sun;
    if (!sun.on) return glm::vec3(0.0f);
    if (!scene.sky.is_atmosphere()) return sun.direction().z > 0.0f ? sun.irradiance : glm::vec3(0.0f);
    const float radius = sun.angular_diameter_deg * (std::numbers::pi_v<float> / 360.0f);
    return sun.irradiance * disc_transmittance(sky_params(scene), radius);
}

float haze(const Scene& scene, double voxels) {
    const gpu::SkyParams sky = sky_params(scene);
    const auto way = static_cast<float>(voxels * double{scene.sky.metres_per_voxel} / kKilometre);
    const glm::vec3 passes = gpu::air_transmittance(sky.air, way * gpu::air_densities(sky.height));
    return 1.0f - std::min({passes.x, passes.y, passes.z});
}

float haze_before_surfaces(const Scene& scene, const Box& voxels) {
    return haze(scene, farthest_surface(scene, voxels));
}

}  // namespace voxilux
