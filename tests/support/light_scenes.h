#pragma once

// Scenes of light in code, for tests against closed forms: no sun, a black sky.

#include <string>

#include "support/test_scenes.h"

namespace voxilux::test {

// `pixels` x `pixels`, with so many photons in each iteration for light between surfaces, and a constant
// radius.
[[nodiscard]] inline Scene dark_scene(int pixels, std::uint32_t photons, double radius) {
    Scene scene;
    scene.sun.on = false;
    scene.sky.radiance = glm::vec3(0.0f);
    scene.settings.size = {pixels, pixels};
    scene.settings.spp = 1;
    scene.settings.paths.indirect = false;
    scene.settings.paths.caustics = false;
    scene.settings.seed = 1;
    scene.settings.photons.count = photons;
    scene.settings.photons.radius = radius;
    scene.settings.photons.alpha = 1.0;
    return scene;
}

inline std::uint16_t add_material(Scene& scene, Material material) {
    scene.materials.push_back(std::move(material));
    return static_cast<std::uint16_t>(scene.materials.size() - 1);
}

inline std::uint16_t add_diffuse(Scene& scene, float albedo) {
    return add_material(scene, {.name = "diffuse", .albedo = glm::vec3(albedo)});
}

// An emitter of this radiance and albedo.
inline std::uint16_t add_emitter(Scene& scene, float radiance, float albedo = 0.0f) {
    return add_material(scene, {.name = "lamp",
                                .albedo = glm::vec3(albedo),
                                .emission = glm::vec3(radiance),
                                .surface = Surface::emit});
}

inline std::uint16_t add_mirror(Scene& scene, float albedo = 1.0f) {
    return add_material(scene, {.name = "mirror",
                                .albedo = glm::vec3(albedo),
                                .surface = Surface::metal,
                                .roughness = 0.0f,
                                .metallic = 1.0f});
}

inline std::uint16_t add_glass(Scene& scene, float ior, float albedo = 1.0f) {
    return add_material(scene, {.name = "glass",
                                .albedo = glm::vec3(albedo),
                                .surface = Surface::glass,
                                .roughness = 0.0f,
                                .ior = ior,
                                .transmission = 1.0f});
}

// A closed room: the cells 0 <= c < size are empty, walls of one voxel around them.
inline void add_room(Scene& scene, glm::ivec3 size, std::uint16_t wall) {
    add_box(scene, {-1, -1, -1}, {size.x + 1, size.y + 1, 0}, wall);
    add_box(scene, {-1, -1, size.z}, {size.x + 1, size.y + 1, size.z + 1}, wall);
    add_box(scene, {-1, -1, 0}, {0, size.y + 1, size.z}, wall);
    add_box(scene, {size.x, -1, 0}, {size.x + 1, size.y + 1, size.z}, wall);
    add_box(scene, {0, -1, 0}, {size.x, 0, size.z}, wall);
    add_box(scene, {0, size.y, 0}, {size.x, size.y + 1, size.z}, wall);
}

}  // namespace voxilux::test
