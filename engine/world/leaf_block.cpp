#include "world/leaf_block.h"

namespace voxilux {
namespace {

// `mask` gives the filled voxels of a brick by its number.
template <class Mask>
BrickSurroundings look_around(const VoxelWorld& world, glm::ivec3 cell, const Mask& mask) {
    BrickSurroundings filled{};
    for (int i = 0; i < 27; ++i) {
        const std::uint32_t number = world.brick_number(cell + glm::ivec3(i % 3, i / 3 % 3, i / 9) - 1);
        if (number != VoxelWorld::kNoBrick) filled[static_cast<std::size_t>(i)] = mask(number);
    }
    return filled;
}

}  // namespace

std::uint64_t filled_mask(const VoxelWorld::Brick& brick) {
    std::uint64_t mask = 0;
    for (std::size_t i = 0; i < 64; ++i)
        mask |= static_cast<std::uint64_t>(brick[i] != VoxelWorld::kEmpty) << i;
    return mask;
}

FilledMasks::FilledMasks(const VoxelWorld& world) : world_(world) {
    masks_.reserve(world.brick_count());
    for (std::uint32_t number = 0; number < world.brick_count(); ++number)
        masks_.push_back(filled_mask(world.brick(number)));
}

BrickSurroundings FilledMasks::around(glm::ivec3 cell) const {
    return look_around(world_, cell, [&](std::uint32_t number) { return masks_[number]; });
}

BrickSurroundings surroundings_of(const VoxelWorld& world, glm::ivec3 cell) {
    return look_around(world, cell, [&](std::uint32_t number) { return filled_mask(world.brick(number)); });
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
