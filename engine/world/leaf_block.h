#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "world/near_boxes.h"
#include "world/voxel_world.h"

namespace voxilux {

// Bit x + 4y + 16z of each filled voxel.
[[nodiscard]] std::uint64_t filled_mask(const VoxelWorld::Brick& brick);

// The filled masks of all bricks of a world, by their numbers.
[[nodiscard]] std::vector<std::uint64_t> filled_masks(const VoxelWorld& world);

// The filled masks of the bricks of a chunk and of those one brick around, for those who look around many.
class ChunkSurroundings {
  public:
    ChunkSurroundings(const VoxelWorld& world, const std::vector<std::uint64_t>& masks,
                      glm::ivec3 chunk_cell);

    // `place` is the brick's in the chunk.
    [[nodiscard]] BrickSurroundings around(glm::ivec3 place) const;

  private:
    static constexpr int kEdge = 6;
    std::array<std::uint64_t, std::size_t{kEdge} * kEdge * kEdge> masks_{};  // x fastest
};

// What around() gives, of one brick of a world; `cell` counts bricks.
[[nodiscard]] BrickSurroundings surroundings_of(const VoxelWorld& world, glm::ivec3 cell);

// The words of a mixed brick: 16 bits per voxel, two to a word (world_cell.h). `boxes` are the distances of
// its cells.
using LeafBlock = std::array<std::uint32_t, 32>;
[[nodiscard]] LeafBlock leaf_block(const VoxelWorld::Brick& brick,
                                   const std::array<std::uint16_t, 64>& boxes);

}  // namespace voxilux
