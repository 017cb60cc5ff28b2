#include <cmath>
#include <numbers>

#include "base/assert.h"
#include "base/colour.h"
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

// `local`: relative to the world.
void check_place(const char* what, const Camera& camera, glm::dvec3 local) {
    for (int a = 0; a < 3; ++a) {
        if (!(std::abs(local[a]) < kFarthestCamera)) {
            throw Error(
                ExitCode::input_refused,
                fmt::format("{} ({}, {}, {}) is over {} voxels from the scene", what, camera.position.x,
                            camera.position.y, camera.position.z, kFarthestCamera));
        }
    }
}

// Moves the corner of an image on the pixel grid to a corner of a voxel. Returns the pixels from there to the
// corner of the image.
glm::uvec2 split_corner(glm::dvec3& corner, const glm::dmat3& basis, double pixels_per_voxel) {
    glm::uvec2 pixel(0);
    for (int axis = 0; axis < 2; ++axis) {
        const glm::dvec3 along = axis == 0 ? basis[0] : -basis[1];
        const double place = glm::dot(corner, along);
        const double pixels = std::round(place * pixels_per_voxel);
        const double voxel = std::floor(pixels / pixels_per_voxel);
        corner += (voxel - place) * along;
        pixel[axis] = static_cast<gpu::uint>(pixels - voxel * pixels_per_voxel);
    }
    const glm::bvec3 is_across = glm::equal(basis[2], glm::dvec3(0.0));
    corner = glm::mix(corner, glm::round(corner), is_across);
    return pixel;
}

// `local`: the middle of an orthographic image, relative to the world.
void place_image(gpu::FrameParams& params, const Camera& camera, glm::dvec3 local, glm::dvec2 size) {
    const glm::dmat3 basis = camera_basis(camera);
    const double scale = camera.pixels_per_voxel;
    VX_ASSERT(scale > 0.0);
    const glm::dvec3 right = size.x / (2.0 * scale) * basis[0], up = size.y / (2.0 * scale) * basis[1];
    for (const glm::dvec3& corner : {up - right, up + right, -up - right, -up + right})
        check_place("a corner of the image of the camera at", camera, local + corner);
    glm::dvec3 corner = local + (size.y * basis[1] - size.x * basis[0]) / (2.0 * scale);
    const bool has_grid = has_pixel_grid(camera);
    if (has_grid) params.camera_pixel = split_corner(corner, basis, scale);
    params.camera_block = has_grid ? static_cast<gpu::uint>(scale) : 1u;
    const double block = has_grid ? 1.0 : 1.0 / scale;
    params.camera_right = glm::vec3(basis[0] * block);
    params.camera_up = glm::vec3(basis[1] * block);
    params.camera_cell = glm::ivec3(glm::floor(corner));
    params.camera_fraction = glm::vec3(corner - glm::floor(corner));
}

void place_camera(gpu::FrameParams& params, const Camera& camera, glm::ivec3 origin, glm::ivec2 size) {
    const glm::dvec3 local = camera.position - glm::dvec3(origin);
    const glm::dvec3 cell = glm::floor(local);
    check_place("camera position", camera, local);
    params.camera_cell = glm::ivec3(cell);
    params.camera_fraction = glm::vec3(local - cell);
    const glm::dmat3 basis = camera_basis(camera);
    params.camera_forward = glm::vec3(basis[2]);
    params.camera_block = 1;
    if (camera.projection == Projection::orthographic)
        return place_image(params, camera, local, glm::dvec2(size));
    params.camera_angle = static_cast<float>(radians(camera.fov_y_deg) / 2.0);
    const bool is_flat = camera.projection == Projection::perspective;
    const double half_height = is_flat ? std::tan(radians(camera.fov_y_deg) / 2.0) : 1.0;
    const double aspect = is_flat ? static_cast<double>(size.x) / static_cast<double>(size.y) : 1.0;
    params.camera_right = glm::vec3(basis[0] * half_height * aspect);
    params.camera_up = glm::vec3(basis[1] * half_height);
}

constexpr double kNearestFocus = 1.0 / 1024.0;  // voxels

void place_lens(gpu::FrameParams& params, const Lens& lens, const Camera& camera) {
    params.lens_radius = static_cast<float>(0.5 * lens.aperture);
    params.lens_blades = lens.blades;
    double distance = lens.focus.value_or(0.0);
    if (!lens.focus && lens.focus_at)
        distance = glm::dot(*lens.focus_at - camera.position, camera_basis(camera)[2]);
    params.lens_power = distance > 0.0 ? static_cast<float>(1.0 / std::max(distance, kNearestFocus)) : 0.0f;
}

void place_lights(gpu::FrameParams& params, const RenderPlan& plan) {
    params.light_count = plan.world.lights.count;
    params.light_power = static_cast<float>(plan.world.lights.power);
    params.emitter_photons = plan.photons.emitter_photons;
    params.sun_photons = plan.photons.sun_photons;
    params.sun_disc_centre = glm::vec3(plan.world.lights.sun_disc.centre);
    params.sun_disc_radius = static_cast<float>(plan.world.lights.sun_disc.radius);
}

// Luminance of the ground where nothing hides the sun or the sky.
float open_luminance(const gpu::FrameParams& params, const Ground& ground) {
    const float cosine = std::max(params.sun_direction.z, 0.0f) * (1.0f - 0.5f * params.sun_cone_height);
    const glm::vec3 light = params.sun_irradiance * (cosine / gpu::kPi) + params.sky_radiance;
    return luminance(ground.albedo * light);
}

}  // namespace

gpu::FrameParams frame_params(const RenderPlan& plan, const Scene& scene, const MarchWorld& march_world) {
    const RenderSettings& settings = plan.settings;
    gpu::FrameParams params{};
    params.chunks = march_world.chunks_size;
    params.world_origin = march_world.origin;
    const Camera camera = on_pixel_grid(camera_of(scene), glm::dvec2(plan.image_size));
    place_camera(params, camera, march_world.origin, plan.image_size);
    if (plan.has(Effect::lens)) place_lens(params, scene.lens, camera);
    params.width = static_cast<gpu::uint>(plan.image_size.x);
    params.height = static_cast<gpu::uint>(plan.image_size.y);
    params.first_column = static_cast<gpu::uint>(plan.first_pixel.x);
    params.column_count = static_cast<gpu::uint>(settings.size.x);
    params.seed = settings.seed;
    params.ao_radius = settings.ao_radius;
    params.sky_radiance =
        plan.has(Effect::sky) && !plan.has_sky_plane() ? scene.sky.radiance : glm::vec3(0.0f);
    params.sky_turn = static_cast<float>(std::remainder(double{scene.sky.rotation_deg}, 360.0) / 360.0);
    params.sun_direction = scene.sun.direction();
    params.sun_irradiance = plan.has(Effect::sun) ? sunlight(scene) : glm::vec3(0.0f);
    params.sun_cone_height =
        gpu::cone_height(static_cast<float>(radians(scene.sun.angular_diameter_deg) / 2.0));
    place_lights(params, plan);
    params.ground_material = plan.material_count - 1;
    params.ground_luminance = open_luminance(params, scene.ground);
    return params;
}

}  // namespace voxilux
