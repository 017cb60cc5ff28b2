#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "shared/aadf.h"
#include "world/cell_bounds.h"

namespace voxilux {

// The boxes around a part of a level, grown from nothing by the steps of aadf.h. Copied out of the structure,
// the cells of a line lie side by side, and an edit is several times as fast as with a look-up of each.
class GrowingBox {
  public:
    // How far the boxes of a level depend on its cells: the sum of how far all rounds look, 1 + 2 + 4 + 8 +
    // 16.
    static constexpr int kReach = 31;

    // For the boxes of the cells in `wanted`, in a level of so many cells.
    GrowingBox(const CellBounds& wanted, glm::ivec3 level);

    // The cells whose contents are to be set: all that the wanted boxes depend on.
    [[nodiscard]] const CellBounds& cells() const { return cells_; }
    // Set a cell whose box grows, and one that is fixed: its distances, or kNotEmpty.
    void set_empty(glm::ivec3 cell) {
        is_growing_[index(cell)] = 1;
        for (int axis = 0; axis < 3; ++axis)
            has_growing_[static_cast<std::size_t>(axis)][line_of(cell, axis)] = 1;
    }
    void set_fixed(glm::ivec3 cell, std::uint32_t distances) { distances_[index(cell)] = distances; }

    void grow();

    // After grow(): those of a wanted cell.
    [[nodiscard]] std::uint32_t distances(glm::ivec3 cell) const { return distances_[index(cell)]; }

  private:
    [[nodiscard]] std::size_t index(glm::ivec3 cell) const {
        const glm::ivec3 place = cell - cells_.low;
        return static_cast<std::size_t>(place.x) + strides_[1] * static_cast<std::size_t>(place.y) +
               strides_[2] * static_cast<std::size_t>(place.z);
    }
    // The number of the line along an axis through a cell. Numbers ascend along x, or along y where x is the
    // axis.
    [[nodiscard]] std::size_t line_of(glm::ivec3 cell, int axis) const {
        const glm::ivec3 place = cell - cells_.low;
        const int across = axis == 0 ? 1 : 0;
        const int last = 3 - axis - across;
        return static_cast<std::size_t>(place[across]) +
               static_cast<std::size_t>(cells_.high[across] - cells_.low[across]) *
                   static_cast<std::size_t>(place[last]);
    }
    void take_step(const gpu::GrowthStep& step);
    void grow_lines(std::size_t start, int width, const gpu::GrowthStep& step, glm::ivec2 range);

    CellBounds wanted_;
    CellBounds cells_;
    glm::ivec3 level_;
    std::size_t strides_[3];
    std::vector<std::uint32_t> distances_;
    std::vector<std::uint8_t> is_growing_;
    std::array<std::vector<std::uint8_t>, 3> has_growing_;  // of lines along each axis
    std::vector<std::uint32_t> line_;  // one or several lines, as they were before the step
};

}  // namespace voxilux
