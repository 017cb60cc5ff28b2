#include "world/structure_bytes.h"

#include <algorithm>

#include "shared/world_cell.h"

namespace voxilux {
namespace {

constexpr std::uint32_t kMixed = 0xFFFFFFFFu;  // more than the 16 bits of a voxel

// The 16 bits that all voxels of the brick have, or kMixed.
std::uint32_t content_of(const VoxelWorld& world, std::uint32_t number) {
    if (number == VoxelWorld::kNoBrick) return VoxelWorld::kEmpty;
    const VoxelWorld::Brick& brick = world.brick(number);
    const bool is_uniform = std::ranges::all_of(brick, [&](std::uint16_t v) { return v == brick[0]; });
    return is_uniform ? brick[0] : kMixed;
}

std::uint64_t cell_count(glm::ivec3 grid) {
    return static_cast<std::uint64_t>(grid.x) * static_cast<std::uint64_t>(grid.y) *
           static_cast<std::uint64_t>(grid.z);
}

}  // namespace

WorldCensus take_census(const VoxelWorld& world) {
    WorldCensus census{.chunks = world.chunks(), .voxels = world.voxel_count()};
    world.for_each_chunk([&](glm::ivec3, const VoxelWorld::ChunkBricks& numbers) {
        std::array<std::uint32_t, 64> contents;
        std::ranges::transform(numbers, contents.begin(),
                               [&](std::uint32_t number) { return content_of(world, number); });
        census.mixed_bricks += static_cast<std::uint64_t>(std::ranges::count(contents, kMixed));
        std::array<std::uint32_t, 8> larger;  // contents of the cells of 8^3
        larger.fill(VoxelWorld::kEmpty);
        for (std::uint32_t slot = 0; slot < 64; ++slot) {
            const glm::ivec3 half = gpu::slot_cell(slot) / 2;
            std::uint32_t& content = larger[static_cast<std::size_t>(half.x + 2 * half.y + 4 * half.z)];
            const bool is_first =
                ((gpu::slot_cell(slot).x | gpu::slot_cell(slot).y | gpu::slot_cell(slot).z) & 1) == 0;
            if (is_first) {
                content = contents[slot];
            } else if (content != contents[slot]) {
                content = kMixed;
            }
        }
        census.mixed_bricks8 += static_cast<std::uint64_t>(std::ranges::count(larger, kMixed));
        const bool is_uniform =
            larger[0] != kMixed &&
            std::ranges::all_of(larger, [&](std::uint32_t content) { return content == larger[0]; });
        if (!is_uniform) ++census.mixed_chunks;
    });
    return census;
}

StructureBytes bytes_of(const MarchWorld& built) {
    return {.roots = 4 * std::uint64_t{built.roots.size()},
            .nodes = 4 * std::uint64_t{built.nodes.size()},
            .leaves = 4 * std::uint64_t{built.leaves.size()}};
}

StructureBytes predict_bytes(const WorldCensus& census, Traversal traversal) {
    const auto id = static_cast<gpu::uint>(traversal);
    const std::uint64_t cells = cell_count((census.chunks * 16) >> gpu::root_log2(id));
    if (traversal == Traversal::dda) return {.leaves = cells};
    if (traversal == Traversal::brick4)
        return {.roots = 4 * cells, .nodes = 8 * census.mixed_bricks, .leaves = 128 * census.mixed_bricks};
    if (traversal == Traversal::brick8)
        return {
            .roots = 4 * cells, .nodes = 64 * census.mixed_bricks8, .leaves = 1024 * census.mixed_bricks8};
    StructureBytes bytes{.roots = 4 * cells};
    if (gpu::has_brick_nodes(id)) bytes.nodes = 256 * census.mixed_chunks;
    bytes.leaves = 128 * census.mixed_bricks;
    return bytes;
}

}  // namespace voxilux
