#include "bench/structure_bytes.h"

#include <algorithm>

#include "shared/world_cell.h"

namespace voxilux {
namespace {

constexpr std::uint64_t kVoxelsPerBrick = 64;

std::uint64_t cell_count(glm::ivec3 grid) {
    return static_cast<std::uint64_t>(grid.x) * static_cast<std::uint64_t>(grid.y) *
           static_cast<std::uint64_t>(grid.z);
}

// Bricks that hold more than one kind of voxel.
std::uint64_t count_mixed_bricks(const VoxelWorld& world) {
    std::uint64_t count = 0;
    world.for_each_chunk([&](glm::ivec3, const VoxelWorld::ChunkBricks& numbers) {
        for (const std::uint32_t number : numbers) {
            if (number == VoxelWorld::kNoBrick) continue;
            const VoxelWorld::Brick& brick = world.brick(number);
            if (std::ranges::any_of(brick, [&](std::uint16_t voxel) { return voxel != brick[0]; })) ++count;
        }
    });
    return count;
}

}  // namespace

StructureBytes bytes_of(const MarchWorld& built) {
    return {.roots = 4 * std::uint64_t{built.roots.size()},
            .nodes = 4 * std::uint64_t{built.nodes.size()},
            .leaves = 4 * std::uint64_t{built.leaves.size()}};
}

StructureBytes least_bytes(const VoxelWorld& world, Traversal traversal) {
    const auto id = static_cast<gpu::uint>(traversal);
    const int log2 = gpu::root_log2(id);
    const std::uint64_t cells = cell_count(world.size() >> log2);
    if (log2 == 0) return {.leaves = cells};  // a byte per voxel
    StructureBytes least{.roots = 4 * cells};
    if (gpu::has_far_voxels(id)) least.leaves = 4 * kVoxelsPerBrick * count_mixed_bricks(world);
    return least;
}

}  // namespace voxilux
