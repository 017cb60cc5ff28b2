#include "support/test_scenes.h"

#include "scene/scene_camera.h"
#include "support/scene_voxels.h"

namespace voxilux::test {

Scene white_scene() {
    Scene scene;
    scene.materials = {{.name = "white", .albedo = glm::vec3(1.0f)}};
    scene.sun.on = false;
    scene.sky.radiance = glm::vec3(1.0f);
    scene.settings.ao.method = AoMethod::brute;
    scene.settings.size = {1, 1};
    scene.settings.spp = 1;
    scene.settings.seed = 1;
    return scene;
}

void add_box(Scene& scene, glm::ivec3 from, glm::ivec3 to, std::uint16_t material) {
    VoxelModel model{.name = "box", .size = to - from};
    for (int z = 0; z < model.size.z; ++z) {
        for (int y = 0; y < model.size.y; ++y) {
            for (int x = 0; x < model.size.x; ++x) {
                model.voxels.push_back({static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y),
                                        static_cast<std::uint16_t>(z), material});
            }
        }
    }
    scene.instances.push_back(
        {.model = static_cast<std::uint32_t>(scene.models.size()), .translation = from + model.size / 2});
    scene.models.push_back(std::move(model));
}

Camera camera_down(glm::dvec3 position, double fov_y_deg) {
    return {.position = position, .yaw_deg = 90.0, .pitch_deg = -90.0, .fov_y_deg = fov_y_deg};
}

Camera camera_towards(glm::dvec3 position, glm::dvec3 target, double fov_y_deg) {
    const YawPitch angles = yaw_pitch_of(target - position);
    return {.position = position,
            .yaw_deg = angles.yaw_deg,
            .pitch_deg = angles.pitch_deg,
            .fov_y_deg = fov_y_deg};
}

Scene lit_plane(float angular_diameter_deg) {
    Scene scene = white_scene();
    add_box(scene, {-40, -40, -1}, {40, 40, 0});
    scene.materials[0].albedo = glm::vec3(0.12f, 0.5f, 0.93f);
    scene.sky.radiance = glm::vec3(0.7f, 0.9f, 1.2f);
    scene.sun = {.azimuth_deg = 300.0f, .elevation_deg = 35.0f, .angular_diameter_deg = angular_diameter_deg};
    scene.camera = camera_down({0, 0, 20}, 50.0);
    scene.settings.size = {32, 32};
    scene.settings.spp = 8;
    return scene;
}

std::vector<glm::ivec3> scene_cells(const Scene& scene) {
    std::vector<glm::ivec3> cells;
    for_each_scene_voxel(scene, [&](glm::ivec3 cell, std::uint16_t) { cells.push_back(cell); });
    return cells;
}

}  // namespace voxilux::test
