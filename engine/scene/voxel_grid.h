#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include <glm/glm.hpp>

#include "scene/scene.h"

namespace voxilux {

// No cell of a grid lies further from the origin on any axis: 2^20 blocks of 8.
inline constexpr int kMaxGridCoordinate = 1 << 23;

// The largest material index that a grid can hold.
inline constexpr std::uint16_t kMaxGridMaterial = 0xFFFE;

// A sparse grid of cells that shapes are drawn into: each holds a material index or nothing. Memory: 1 KiB
// for each block of 8^3 cells that has ever held a voxel.
class VoxelGrid {
  public:
    // Sets the cells [x0, x1) of a row; an absent material empties them. Coordinates within
    // kMaxGridCoordinate.
    void fill_row(int x0, int x1, glm::ivec2 yz, std::optional<std::uint16_t> material);
    void set(glm::ivec3 cell, std::optional<std::uint16_t> material) {
        fill_row(cell.x, cell.x + 1, {cell.y, cell.z}, material);
    }

    [[nodiscard]] std::optional<std::uint16_t> at(glm::ivec3 cell) const;
    // z of the highest voxel of a column.
    [[nodiscard]] std::optional<int> top_of_column(int x, int y) const;

    // Adds the voxels to the scene, each at the cell it has here, as few models as Voxel's 16 bits allow:
    // none when the grid is empty. The order of the voxels depends only on the cells that are filled.
    void append_to(Scene& scene, const std::string& name) const;

  private:
    static constexpr int kSide = 8;
    static constexpr std::uint16_t kEmpty = 0xFFFF;
    using Block = std::array<std::uint16_t, kSide * kSide * kSide>;

    [[nodiscard]] const Block* find(glm::ivec3 block) const;
    [[nodiscard]] std::vector<std::uint64_t> sorted_keys() const;
    void append_model(Scene& scene, const std::string& name, std::span<const std::uint64_t> keys) const;

    std::unordered_map<std::uint64_t, std::unique_ptr<Block>> blocks_;
    glm::ivec2 z_blocks_{0};  // half-open range of the blocks' z
};

}  // namespace voxilux
