#pragma once

// Thin coverage and the crossings that decide what is inside: where lines through cell centres meet a
// triangle, in exact integers.

#include <array>

#include "voxelizer/cover_triangle.h"
#include "voxelizer/mesh_grid.h"

namespace voxilux {

// The lines through cell centres along one axis that meet a triangle. Closed: lines on an edge count, for
// every triangle at that edge. Otherwise a line on an edge that two triangles share counts for one of them if
// they are on opposite sides, and for both or neither if they are on the same side.
class LineCrossings {
  public:
    LineCrossings(const LatticeTriangle& triangle, int axis, bool is_closed);

    // Whether the triangle has any area when seen along the axis.
    [[nodiscard]] bool is_seen() const { return area_ != 0; }
    // 1 when the triangle's normal, corners counter-clockwise, points along the axis; else -1.
    [[nodiscard]] int facing() const { return area_ > 0 ? 1 : -1; }
    // The cells of `range` on the next axis (y after x, z after y, x after z) whose line, at cell `v` of the
    // axis after that, meets the triangle.
    [[nodiscard]] CellRange cells_at(std::int32_t v, CellRange range) const;
    // The lattice step, rounded down, at which the line through the centre of cell (u, v) meets the plane.
    [[nodiscard]] std::int64_t crossing(std::int32_t u, std::int32_t v) const;

  private:
    PlaneProjection projection_;
    std::int64_t area_ = 0;
    std::array<__int128, 3> normal_{};  // along u, v and the axis; the last above 0
    glm::ivec3 corner_{0};              // likewise
};

// Calls emit(cell) for the cells in `within` where one of the three segments between the centres of opposite
// faces meets the triangle: a 6-separating surface (S. Laine, "A Topological Approach to Voxelization",
// 2013). Cells may be emitted more than once. Each is one of those that the triangle touches.
template <class Emit>
void for_each_crossing(const LatticeTriangle& triangle, const CellBox& within, const Emit& emit) {
    const CellBox box = cell_box(triangle, kUnit);
    const glm::ivec3 low = glm::max(box.low, within.low);
    const glm::ivec3 high = glm::min(box.high, within.high);
    if (low.x > high.x || low.y > high.y || low.z > high.z) return;
    for (int axis = 0; axis < 3; ++axis) {
        const LineCrossings lines(triangle, axis, true);
        if (!lines.is_seen()) continue;
        const int u = (axis + 1) % 3;
        const int v = (axis + 2) % 3;
        glm::ivec3 cell;
        for (cell[v] = low[v]; cell[v] <= high[v]; ++cell[v]) {
            const CellRange range = lines.cells_at(cell[v], {low[u], high[u]});
            for (cell[u] = range.first; cell[u] <= range.last; ++cell[u]) {
                cell[axis] = static_cast<int>(lines.crossing(cell[u], cell[v]) >> kUnitBits);
                if (cell[axis] >= low[axis] && cell[axis] <= high[axis]) emit(cell);
            }
        }
    }
}

}  // namespace voxilux
