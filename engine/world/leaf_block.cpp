#include "world/leaf_block.h"

#include "base/parallel_blocks.h"

namespace voxilux {
namespace {

constexpr std::size_t kBricksAtOnce = 4096;

}  // namespace

std::uint64_t filled_mask(const VoxelWorld::Brick& brick) {
    std::uint64_t mask = 0;
    for (std::size_t i = 0; i < 64; ++i)
        mask |= static_cast<std::uint64_t>(brick[i] != VoxelWorld::kEmpty) << i;
    return mask;
}

std::vector<std::uint64_t> filled_masks(const VoxelWorld& world) {
    std::vector<std::uint64_t> masks(world.brick_count());
    for_each_part(masks.size(), kBricksAtOnce, [&](std::size_t first, std::size_t end) {
        for (std::size_t i = first; i < end; ++i)
            masks[i] = filled_mask(world.brick(static_cast<std::uint32_t>(i)));
    });
    return masks;
}

ChunkSurroundings::ChunkSurroundings(const VoxelWorld& world, const std::vector<std::uint64_t>& masks,
                                     glm::ivec3 chunk_cell) {
    std::size_t i = 0;
    for (int z = -1; z <= 4; ++z)
        for (int y = -1; y <= 4; ++y)
            for (int x = -1; x <= 4; ++x, ++i) {
                const std::uint32_t number = world.brick_number(chunk_cell * 4 + glm::ivec3(x, y, z));
                if (number != VoxelWorld::kNoBrick) masks_[i] = masks[number];
            }
}

BrickSurroundings ChunkSurroundings::around(glm::ivec3 place) const {
    BrickSurroundings filled;
    for (int i = 0; i < 27; ++i) {
        const glm::ivec3 at = place + glm::ivec3(i % 3, i / 3 % 3, i / 9);
        filled[static_cast<std::size_t>(i)] =
            masks_[static_cast<std::size_t>(at.x + kEdge * (at.y + kEdge * at.z))];
    }
    return filled;
}

BrickSurroundings surroundings_of(const VoxelWorld& world, glm::ivec3 cell) {
    BrickSurroundings filled{};
    for (int i = 0; i < 27; ++i) {
        const std::uint32_t number = world.brick_number(cell + glm::ivec3(i % 3, i / 3 % 3, i / 9) - 1);
        if (number != VoxelWorld::kNoBrick)
            filled[static_cast<std::size_t>(i)] = filled_mask(world.brick(number));
    }
    return filled;
}

LeafBlock leaf_block(const VoxelWorld::Brick& brick, const std::array<std::uint16_t, 64>& boxes) {
    const auto half = [&](std::size_t i) {
        return std::uint32_t{brick[i] != VoxelWorld::kEmpty ? brick[i] : boxes[i]};
    };
    LeafBlock block;
    for (std::size_t i = 0; i < block.size(); ++i)
        block[i] = half(2 * i) | (half(2 * i + 1) << 16);
    return block;
}

}  // namespace voxilux
