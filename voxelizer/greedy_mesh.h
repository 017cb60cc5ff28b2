#pragma once

// Voxels as few rectangles: faces between a voxel and transparent or empty cells, joined along rows and then
// across them where they have the same palette index (M. Lysenko, "Meshing in a Minecraft Game", 2012).

#include <array>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "scene/vox_file.h"

namespace voxilux {

struct IndexedCell {
    glm::ivec3 cell{0};
    std::uint8_t index = 0;  // in the palette, from 1

    bool operator==(const IndexedCell&) const = default;
};

// A rectangle of faces. It reaches `size` cells from `low` on the axes (axis + 1) % 3 and (axis + 2) % 3.
struct VoxelQuad {
    glm::ivec3 low{0};
    glm::ivec2 size{1};
    std::uint8_t axis = 0;  // its normal
    bool is_positive = false;
    std::uint8_t index = 0;
};

// The cells of all visible instances at frame 0, each once: where several fill one, the last counts. Throws
// Error(input_refused) where the graph cannot be traversed, and beyond 2^25 cells.
[[nodiscard]] std::vector<IndexedCell> cells_of_file(const VoxFile& file);

// The faces of the cells, which must be unique. Cells with a transparent index do not hide the faces behind
// them. Throws Error(input_refused) as soon as there are over `max_quads`.
[[nodiscard]] std::vector<VoxelQuad> greedy_quads(std::vector<IndexedCell> cells,
                                                  const std::array<bool, 256>& is_clear,
                                                  std::size_t max_quads);

}  // namespace voxilux
