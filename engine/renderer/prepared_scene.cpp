#include "renderer/prepared_scene.h"

#include <algorithm>
#include <utility>

#include "frame/footprint.h"
#include "plan/choose_traversal.h"
#include "scene/scene_camera.h"
#include "shared/limits.h"
#include "world/build_fields.h"
#include "world/sphere_tree.h"

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

// Room for the bricks and chunks that edits make mixed, until the structure is built anew.
constexpr std::uint64_t kMinRoomBytes = std::uint64_t{1} << 18;
void leave_room(WorldFacts& world, MarchWorld& built) {
    for (std::uint64_t* bytes : {&world.node_bytes, &world.leaf_bytes})
        *bytes += std::max(*bytes / 4 & ~std::uint64_t{3}, kMinRoomBytes);
    built.nodes.reserve(world.node_bytes / sizeof(std::uint32_t));
    built.leaves.reserve(world.leaf_bytes / sizeof(std::uint32_t));
}

}  // namespace

PreparedScene prepare_scene(const Scene& scene, const PlanRequest& request, const DeviceLimits& limits) {
    StepTimes times;
    const SceneFacts facts = measure_scene(scene);
    times.end_step("facts");
    const VoxelWorld world = build_world(scene);
    times.end_step("flatten");
    return prepare_scene(scene, facts, world, request, limits, std::move(times));
}

PreparedScene prepare_scene(const Scene& scene, const SceneFacts& facts, const VoxelWorld& world,
                            const PlanRequest& request, const DeviceLimits& limits, StepTimes times) {
    PreparedScene prepared{.facts = facts, .times = std::move(times)};
    TraversalChoice choice;
    if (facts.has_voxels) {
        choice = choose_traversal(take_census(world), request.traversal, request.memory_budget_bytes, limits);
        prepared.march_world = build_unexpanded_world(world, choice.traversal);
        prepared.times.end_step("structure");
    } else {
        prepared.march_world.origin = nearest_to_camera(scene);
        prepared.march_world.roots = {0};
    }
    const glm::ivec3 origin = prepared.march_world.origin;
    if (limits.is_cpu) {
        grow_boxes(prepared.march_world);
        prepared.times.end_step("boxes");
    }
    prepared.lights = find_lights(scene, facts.has_voxels ? &world : nullptr, origin);
    WorldFacts world_facts = measure_world(prepared.march_world);
    if (limits.is_cpu) world_facts.growth = {};
    world_facts.traversal_reason = choice.reason;
    world_facts.lights = measure_lights(scene, prepared.lights, prepared.march_world.size(), origin);
    aim_photons(scene, facts, origin, request, prepared.lights, world_facts.lights);
    if (scene.spheres.size() + scene.ground.count() > gpu::kFewSpheres) {
        const std::vector<gpu::SphereNode> tree = build_sphere_tree(sphere_records(scene, origin));
        world_facts.sphere_nodes = tree.size();
        world_facts.sphere_visits = mean_visits(tree);
    }
    if (request.leaves_room) leave_room(world_facts, prepared.march_world);
    prepared.plan = plan_within_memory(scene, prepared.facts, world_facts, request, limits);
    prepared.times.end_step("plan");
    return prepared;
}

void aim_photons(const Scene& scene, const SceneFacts& facts, glm::ivec3 origin, const PlanRequest& request,
                 LightList& lights, LightFacts& measured) {
    lights.aims = {};
    measured.aims.reset();
    if (!aims_photons(scene, facts, request)) return;
    lights.aims = find_photon_aims(scene, lights, origin);
    measured.aims = measure_aims(lights.aims);
}

}  // namespace voxilux
