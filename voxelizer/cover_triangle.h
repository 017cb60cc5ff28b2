#pragma once

// Which cells a triangle touches: separating axes of a triangle and a box (T. Akenine-Moller, "Fast 3D
// Triangle-Box Overlap Testing", 2001) in the form of half-planes in three projections and a slab (M. Schwarz
// and H.-P. Seidel, "Fast Parallel Surface and Solid Voxelization on GPUs", 2010), in exact integers. Each
// half-plane is linear in x, so the cells of a row along x are an interval: one division per half-plane, no
// test per cell. Cells are half open, [c, c+1): a point belongs to one cell even on a grid plane, and a
// surface has no hole because each of its points lies in a cell that it touches. A bound that a box
// approaches but does not reach is strict, hence the +1 in `bound`.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>

#include <glm/glm.hpp>

namespace voxilux {

using LatticeTriangle = std::array<glm::ivec3, 3>;

// first..last; empty when last < first.
struct CellRange {
    std::int32_t first = 0;
    std::int32_t last = -1;

    [[nodiscard]] bool empty() const { return last < first; }
};

// Cells low..high on each axis.
struct CellBox {
    glm::ivec3 low{0};
    glm::ivec3 high{-1};
};

// The cells (of `unit` lattice steps) of the triangle's bounding box.
[[nodiscard]] CellBox cell_box(const LatticeTriangle& triangle, std::int32_t unit);

// a u + b v >= bound for cells (u, v) that a projected triangle may touch.
struct HalfPlane {
    std::int64_t a = 0;
    std::int64_t b = 0;
    std::int64_t bound = 0;
};

// The triangle's projection along one axis. Three half-planes, or six when it is a segment or a point.
struct PlaneProjection {
    std::array<HalfPlane, 6> rules;
    int count = 0;

    // The part of `range` (of u) that satisfies all of them at v.
    [[nodiscard]] CellRange cells_at(std::int32_t v, CellRange range) const;
};

// The slab between a box's corners that are farthest along the triangle's normal. T holds 6 extent^3.
template <class T>
struct Slab {
    std::array<T, 3> step{};      // of n . corner, per cell; x >= 0
    T low{};                      // n . corner at the box `origin`, for the corner farthest along n
    T high{};                     // likewise against n
    T low_bound{}, high_bound{};  // low >= low_bound, high <= high_bound
    glm::ivec3 origin{0};
    bool is_needed = false;  // not for axis-aligned planes, where the bounding box suffices

    [[nodiscard]] CellRange cells_at(std::int32_t y, std::int32_t z, CellRange range) const;
};

// Integer division rounded towards minus infinity; b > 0. For the wide type the quotient saturates at 2^40.
[[nodiscard]] std::int64_t floor_quotient(std::int64_t a, std::int64_t b);
[[nodiscard]] std::int64_t floor_quotient(__int128 a, __int128 b);

// Everything that is computed of a triangle before cells are visited.
struct TriangleCover {
    CellBox box;
    PlaneProjection xy, xz, yz;  // u is the first axis
    Slab<std::int64_t> slab;
    Slab<__int128> wide_slab;  // for triangles too large for the other
    bool is_wide = false;
};

[[nodiscard]] TriangleCover cover_of(const LatticeTriangle& triangle, std::int32_t unit);

template <class Emit>
void for_each_span(const TriangleCover& cover, const CellBox& within, const Emit& emit);

// ---- templates ----

// The intersection of `range` with first..last.
[[nodiscard]] inline CellRange inside(CellRange range, std::int64_t first, std::int64_t last) {
    first = std::max<std::int64_t>(range.first, first);
    last = std::min<std::int64_t>(range.last, last);
    if (last < first) return {};
    return {static_cast<std::int32_t>(first), static_cast<std::int32_t>(last)};
}

template <class T>
CellRange Slab<T>::cells_at(std::int32_t y, std::int32_t z, CellRange range) const {
    const T across = step[1] * (y - origin.y) + step[2] * (z - origin.z);
    const T least = low_bound - low - across;   // step x >= least
    const T most = high_bound - high - across;  // step x <= most
    if (step[0] == 0) return least <= 0 && most >= 0 ? range : CellRange{};
    const std::int64_t first = origin.x - floor_quotient(-least, step[0]);
    const std::int64_t last = origin.x + floor_quotient(most, step[0]);
    return inside(range, first, last);
}

// Calls emit(y, z, first x, last x) for the rows of cells in `within` that the triangle touches, ordered by
// z, then y.
template <class Emit>
void for_each_span(const TriangleCover& cover, const CellBox& within, const Emit& emit) {
    constexpr int kTableRows = 64;  // rows whose xy interval is kept: those of a block
    const glm::ivec3 low = glm::max(cover.box.low, within.low);
    const glm::ivec3 high = glm::min(cover.box.high, within.high);
    if (low.x > high.x || low.y > high.y || low.z > high.z) return;
    if (cover.box.low.y == cover.box.high.y && cover.box.low.z == cover.box.high.z)
        return emit(low.y, low.z, low.x, high.x);
    std::array<CellRange, kTableRows> table;
    for (std::int32_t y = low.y; y <= std::min(high.y, low.y + kTableRows - 1); ++y)
        table[static_cast<std::size_t>(y - low.y)] = cover.xy.cells_at(y, {low.x, high.x});
    for (std::int32_t z = low.z; z <= high.z; ++z) {
        const CellRange rows = cover.yz.cells_at(z, {low.y, high.y});
        if (rows.empty()) continue;
        const CellRange columns = cover.xz.cells_at(z, {low.x, high.x});
        for (std::int32_t y = rows.first; y <= rows.last && !columns.empty(); ++y) {
            CellRange x = y - low.y < kTableRows ? table[static_cast<std::size_t>(y - low.y)]
                                                 : cover.xy.cells_at(y, columns);
            x = {std::max(x.first, columns.first), std::min(x.last, columns.last)};
            if (cover.slab.is_needed && !x.empty())
                x = cover.is_wide ? cover.wide_slab.cells_at(y, z, x) : cover.slab.cells_at(y, z, x);
            if (!x.empty()) emit(y, z, x.first, x.last);
        }
    }
}

}  // namespace voxilux
