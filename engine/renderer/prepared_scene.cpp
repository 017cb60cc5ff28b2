#include "renderer/prepared_scene.h"

#include "frame/footprint.h"
#include "plan/choose_traversal.h"
#include "scene/scene_camera.h"

namespace voxilux {
namespace {

// Local coordinates of a scene without voxels are counted from its point nearest to the camera, so that even
// the top of a sphere of radius 10^6 keeps its precision where it is seen.
glm::ivec3 nearest_to_camera(const Scene& scene) {
    const Box box = scene_bounds(scene);
    if (box.empty()) return glm::ivec3(0);
    return glm::ivec3(
        glm::clamp(glm::floor(camera_of(scene).position), glm::dvec3(box.lo), glm::dvec3(box.hi)));
}

}  // namespace

PreparedScene prepare_scene(const Scene& scene, const PlanRequest& request, const DeviceLimits& limits) {
    PreparedScene prepared{.facts = measure_scene(scene)};
    TraversalChoice choice;
    if (prepared.facts.has_voxels) {
        const VoxelWorld world = build_world(scene);
        choice = choose_traversal(take_census(world), request.traversal, request.memory_budget_bytes, limits);
        prepared.march_world = build_march_skeleton(world, choice.traversal);
        prepared.lights = find_lights(scene, &world, world.origin());
    } else {
        prepared.march_world.origin = nearest_to_camera(scene);
        prepared.march_world.roots = {0};
        prepared.lights = find_lights(scene, nullptr, prepared.march_world.origin);
    }
    WorldFacts world_facts = measure_world(prepared.march_world);
    world_facts.traversal_reason = choice.reason;
    world_facts.lights =
        measure_lights(scene, prepared.lights, prepared.march_world.size(), prepared.march_world.origin);
    prepared.plan = plan_within_memory(scene, prepared.facts, world_facts, request, limits);
    return prepared;
}

}  // namespace voxilux
