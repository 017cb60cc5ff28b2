#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "shared/photon_aim.h"

namespace voxilux {

// A grid of cells over a rectangle, some of them marked (shared/photon_aim.h).
class AimGrid {
  public:
    AimGrid(glm::dvec2 low, glm::dvec2 high, glm::ivec2 size);

    [[nodiscard]] glm::ivec2 size() const { return size_; }
    // The extent of a row along the second axis.
    [[nodiscard]] glm::dvec2 row(int number) const;
    // The first and the last row that a range of that axis touches; none where the last is before the first.
    [[nodiscard]] glm::ivec2 rows(double from, double to) const;
    // Marks what a range of the first axis touches. Where the axis is a turn, it goes round.
    void mark(int row, double from, double to);
    void mark_turned(int row, double from, double to);

    // The map of the marked cells, which follow those that are in the list.
    [[nodiscard]] gpu::AimMap append_to(std::vector<gpu::uvec2>& cells) const;

  private:
    [[nodiscard]] bool is_marked(int column, int row) const;
    void mark_columns(int row, std::int64_t first, std::int64_t last);

    gpu::vec2 low_;  // as the device knows them
    gpu::vec2 cell_;
    glm::ivec2 size_;
    std::vector<bool> marks_;
};

}  // namespace voxilux
