#include "world/lights.h"

#include <algorithm>

#include "base/error.h"
#include "scene/atmosphere.h"
#include "scene/lobe_weights.h"
#include "shared/light.h"
#include "shared/world_cell.h"
#include "world/specular_boxes.h"

namespace voxilux {
namespace {

constexpr std::size_t kMaxLights = std::size_t{1} << 24;
// Largest radius, voxels, of spheres that the sun's photons are aimed at. Larger ones serve as walls and
// grounds, and a disc that covers them would waste nearly all photons.
constexpr double kLargestLitSphere = 1024.0;
constexpr double kDiscMargin = 1.001;  // covers the rounding of positions on the disc

bool is_open(const Scene& scene, const VoxelWorld& world, glm::ivec3 cell) {
    const std::uint16_t voxel = world.get(cell);
    if (voxel == VoxelWorld::kEmpty) return true;
    return lobe_weights(scene.materials.at(voxel & 0x7FFFu)).glass > 0.0f;
}

struct Collector {
    LightList list;
    std::vector<double> powers;

    void add(const gpu::LightRecord& record, double power) {
        if (list.records.size() + 1 >= kMaxLights)
            throw Error(
                ExitCode::input_refused,
                fmt::format("the scene has {} emitters or more (each face of an emitting voxel is one); "
                            "use fewer emitting voxels",
                            kMaxLights));
        list.records.push_back(record);
        powers.push_back(power);
    }
};

void collect_spheres(const Scene& scene, Collector& lights) {
    const std::vector<std::uint32_t> order = sphere_order(scene);
    for (std::uint32_t number = 0; number < order.size(); ++number) {
        const Sphere& sphere = scene.spheres[order[number]];
        const glm::vec3 emission = scene.materials.at(sphere.material).emission;
        const double bright = static_cast<double>(gpu::brightness(emission));
        if (bright > 0.0)
            lights.add({.what = gpu::light_sphere(number)},
                       bright * gpu::sphere_emission_etendue(static_cast<float>(sphere.radius)));
    }
}

void collect_faces(const Scene& scene, const VoxelWorld& world, Collector& lights) {
    // Without emitters, a look at every voxel would take half the time of an edit of a large world.
    const auto emits = [](const Material& material) { return gpu::brightness(material.emission) > 0.0f; };
    if (std::ranges::none_of(scene.materials, emits)) return;
    world.for_each_voxel([&](glm::ivec3 cell, std::uint16_t voxel) {
        const std::uint32_t material = voxel & 0x7FFFu;
        const double bright = static_cast<double>(gpu::brightness(scene.materials.at(material).emission));
        if (!(bright > 0.0)) return;
        for (std::uint32_t face = 0; face < gpu::kFaceCount; ++face) {
            const glm::ivec3 beyond = cell + glm::ivec3(gpu::face_normal(face));
            if (is_open(scene, world, beyond))
                lights.add({.cell = cell, .what = gpu::light_face(face, material)},
                           bright * gpu::kFaceEtendue);
        }
    });
}

void measure_power(const Scene& scene, Collector& lights) {
    const std::vector<std::uint32_t> order = sphere_order(scene);
    for (std::size_t i = 0; i < lights.list.records.size(); ++i) {
        const gpu::LightParts parts = gpu::light_parts(lights.list.records[i].what);
        const std::uint32_t material =
            parts.kind == gpu::kLightSphere ? scene.spheres[order[parts.sphere]].material : parts.material;
        const glm::dvec3 emission(scene.materials.at(material).emission);
        const double etendue = lights.powers[i] / (emission.x + emission.y + emission.z);
        const auto pdf = static_cast<double>(lights.list.table[i].pdf);
        lights.list.max_power = glm::max(lights.list.max_power, emission * (etendue / pdf));
    }
}

SunDisc sun_disc(const Scene& scene, const VoxelWorld* world, glm::ivec3 origin) {
    glm::dvec3 low(1e30), high(-1e30);
    if (world != nullptr) {
        low = glm::dvec3(0.0);
        high = glm::dvec3(world->size());
    }
    for (const Sphere& sphere : scene.spheres) {
        if (sphere.radius > kLargestLitSphere) continue;
        const glm::dvec3 centre = sphere.centre - glm::dvec3(origin);
        low = glm::min(low, centre - sphere.radius);
        high = glm::max(high, centre + sphere.radius);
    }
    if (low.x > high.x) return {};
    return {.centre = 0.5 * (low + high), .radius = kDiscMargin * 0.5 * glm::length(high - low)};
}

}  // namespace

LightList find_lights(const Scene& scene, const VoxelWorld* world, glm::ivec3 origin) {
    Collector lights;
    collect_spheres(scene, lights);
    if (world != nullptr) collect_faces(scene, *world, lights);
    lights.list.table = build_alias_table(lights.powers);
    for (const double power : lights.powers)
        lights.list.power += power;
    measure_power(scene, lights);
    lights.list.sun_disc = sun_disc(scene, world, origin);
    if (!lights.list.records.empty() || gpu::brightness(sunlight(scene)) > 0.0f)
        lights.list.specular = find_specular(scene, world, origin);
    return std::move(lights.list);
}

}  // namespace voxilux
