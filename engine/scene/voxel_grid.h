#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

#include "scene/scene.h"

namespace voxilux {

// No cell of a grid lies further from the origin on any axis.
inline constexpr int kMaxGridCoordinate = 1 << 23;

// A sparse grid of cells that shapes are drawn into: each holds a material index or nothing. Time and memory
// are in proportion to the runs of equal cells along x, and so to the visible faces, not to the cells.
class VoxelGrid {
  public:
    // Sets the cells [x0, x1) of a row; an absent material empties them. Coordinates within
    // kMaxGridCoordinate.
    void fill_row(int x0, int x1, glm::ivec2 yz, std::optional<std::uint16_t> material);
    void set(glm::ivec3 cell, std::optional<std::uint16_t> material) {
        fill_row(cell.x, cell.x + 1, {cell.y, cell.z}, material);
    }

    // z of the highest voxel of a column; nothing in an empty one.
    [[nodiscard]] std::optional<int> top_of_column(int x, int y) const;

    // Adds the voxels to the scene as the boxes of a model, each cell at its place; an empty grid adds no
    // model. The boxes depend only on which cells are filled.
    void append_to(Scene& scene, const std::string& name) const;

  private:
    // The cells [x0, x1).
    struct Run {
        int x0 = 0;
        int x1 = 0;
        std::uint16_t material = 0;
    };
    using Row = std::vector<Run>;  // in order; runs of one material do not touch

    [[nodiscard]] std::vector<VoxelBox> boxes() const;

    std::map<std::pair<int, int>, Row> rows_;  // by y and z; none is empty
};

}  // namespace voxilux
