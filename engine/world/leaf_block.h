#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "world/near_boxes.h"
#include "world/voxel_world.h"

namespace voxilux {

// Bit x + 4y + 16z of each filled voxel.
[[nodiscard]] std::uint64_t filled_mask(const VoxelWorld::Brick& brick);

// The filled masks of all bricks of a world, for use with many bricks.
class FilledMasks {
  public:
    explicit FilledMasks(const VoxelWorld& world);

    // `cell` counts bricks.
    [[nodiscard]] BrickSurroundings around(glm::ivec3 cell) const;

  private:
    const VoxelWorld& world_;
    std::vector<std::uint64_t> masks_;  // by brick number
};

// What around() gives, for a single brick.
[[nodiscard]] BrickSurroundings surroundings_of(const VoxelWorld& world, glm::ivec3 cell);

// The words of a mixed brick: 16 bits per voxel, two to a word (world_cell.h). `boxes` are the distances of
// its cells.
using LeafBlock = std::array<std::uint32_t, 32>;
[[nodiscard]] LeafBlock leaf_block(const VoxelWorld::Brick& brick,
                                   const std::array<std::uint16_t, 64>& boxes);

}  // namespace voxilux
