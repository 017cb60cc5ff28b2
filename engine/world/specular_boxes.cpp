#include "world/specular_boxes.h"

#include <algorithm>

#include "scene/lobe_weights.h"

namespace voxilux {
namespace {

// More take longer to mark in the grids of emitters, and hardly leave more cells out.
constexpr std::size_t kMostBoxes = 256;

bool is_specular(const Material& material) {
    const LobeWeights shares = lobe_weights(material);
    return shares.mirror + shares.glass > 0.0f;
}

void add_brick(const VoxelWorld::Brick& brick, glm::ivec3 corner, const std::vector<bool>& specular,
               BoxClusters& boxes) {
    glm::ivec3 low(4), high(0);
    for (int i = 0; i < 64; ++i) {
        const std::uint16_t voxel = brick[static_cast<std::size_t>(i)];
        if (voxel == VoxelWorld::kEmpty || !specular.at(voxel & 0x7FFFu)) continue;
        const glm::ivec3 cell(i & 3, (i >> 2) & 3, i >> 4);
        low = glm::min(low, cell);
        high = glm::max(high, cell + 1);
    }
    if (low.x < high.x) boxes.add(0, corner, {glm::dvec3(corner + low), glm::dvec3(corner + high)});
}

void add_voxels(const VoxelWorld& world, const std::vector<bool>& specular, BoxClusters& boxes) {
    world.for_each_chunk([&](glm::ivec3 chunk, const VoxelWorld::ChunkBricks& numbers) {
        for (int slot = 0; slot < 64; ++slot) {
            const std::uint32_t number = numbers[static_cast<std::size_t>(slot)];
            if (number == VoxelWorld::kNoBrick) continue;
            const glm::ivec3 corner = chunk * 16 + glm::ivec3(slot & 3, (slot >> 2) & 3, slot >> 4) * 4;
            add_brick(world.brick(number), corner, specular, boxes);
        }
    });
}

}  // namespace

std::vector<RoundedBox> find_specular(const Scene& scene, const VoxelWorld* world, glm::ivec3 origin) {
    std::vector<bool> specular;
    for (const Material& material : scene.materials)
        specular.push_back(is_specular(material));
    if (std::ranges::find(specular, true) == specular.end()) return {};
    BoxClusters boxes(kMostBoxes);
    if (world != nullptr) add_voxels(*world, specular, boxes);
    for (const Sphere& sphere : scene.spheres) {
        if (!specular.at(sphere.material)) continue;
        const glm::dvec3 centre = sphere.centre - glm::dvec3(origin);
        boxes.add(1, glm::ivec3(glm::floor(centre)), {centre, centre, sphere.radius});
    }
    std::vector<RoundedBox> all;
    for (const BoxClusters::Cluster& cluster : boxes.clusters())
        all.push_back(cluster.box);
    return all;
}

}  // namespace voxilux
