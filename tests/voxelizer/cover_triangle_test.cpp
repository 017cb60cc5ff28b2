// Which cells a triangle touches, against all 13 separating axes in wide integers.

#include "voxelizer/cover_triangle.h"

#include <gtest/gtest.h>

#include <random>
#include <set>
#include <tuple>

#include "voxelizer/mesh_grid.h"
#include "voxelizer/thin_cover.h"

namespace voxilux {
namespace {

using Wide = __int128;
using WideVec = std::array<Wide, 3>;
using Cells = std::set<std::tuple<int, int, int>>;

// Lattice steps are cut into so many parts that the box [c, c + 1 - 1/kParts] stands for the half-open cell:
// more than any component of an axis.
constexpr Wide kParts = static_cast<Wide>(1) << 40;

WideVec cross(const WideVec& a, const WideVec& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// Whether `axis` separates the triangle from the closed box, all scaled by kParts.
bool separates(const WideVec& axis, const LatticeTriangle& triangle, glm::ivec3 cell, Wide missing) {
    Wide tri_low = 0, tri_high = 0, box_low = 0, box_high = 0;
    for (std::size_t corner = 0; corner < 3; ++corner) {
        Wide at = 0;
        for (std::size_t k = 0; k < 3; ++k)
            at += axis[k] * triangle[corner][static_cast<int>(k)] * kParts;
        tri_low = corner == 0 || at < tri_low ? at : tri_low;
        tri_high = corner == 0 || at > tri_high ? at : tri_high;
    }
    for (int corner = 0; corner < 8; ++corner) {
        Wide at = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const Wide low = static_cast<Wide>(cell[static_cast<int>(k)]) * kUnit * kParts;
            at += axis[k] * ((corner >> k & 1) != 0 ? low + kUnit * kParts - missing : low);
        }
        box_low = corner == 0 || at < box_low ? at : box_low;
        box_high = corner == 0 || at > box_high ? at : box_high;
    }
    return tri_high < box_low || tri_low > box_high;
}

bool touches(const LatticeTriangle& triangle, glm::ivec3 cell, Wide missing = 1) {
    std::array<WideVec, 3> edges;
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::ivec3 edge = triangle[(i + 1) % 3] - triangle[i];
        edges[i] = {edge.x, edge.y, edge.z};
    }
    std::vector<WideVec> axes = {cross(edges[0], edges[1])};
    for (std::size_t k = 0; k < 3; ++k) {
        WideVec unit{};
        unit[k] = 1;
        axes.push_back(unit);
        for (const WideVec& edge : edges)
            axes.push_back(cross(unit, edge));
    }
    return std::ranges::none_of(
        axes, [&](const WideVec& axis) { return separates(axis, triangle, cell, missing); });
}

Cells touched(const LatticeTriangle& triangle, const CellBox& box, Wide missing = 1) {
    Cells cells;
    for (int z = box.low.z; z <= box.high.z; ++z) {
        for (int y = box.low.y; y <= box.high.y; ++y) {
            for (int x = box.low.x; x <= box.high.x; ++x) {
                if (touches(triangle, {x, y, z}, missing)) cells.insert({x, y, z});
            }
        }
    }
    return cells;
}

Cells covered(const LatticeTriangle& triangle, const CellBox& box) {
    Cells cells;
    for_each_span(cover_of(triangle, kUnit), box, [&](int y, int z, int first, int last) {
        for (int x = first; x <= last; ++x)
            EXPECT_TRUE(cells.insert({x, y, z}).second) << "a row comes once";
    });
    return cells;
}

CellBox around(const LatticeTriangle& triangle) {
    const CellBox box = cell_box(triangle, kUnit);
    return {glm::max(box.low - 1, glm::ivec3(0)), box.high + 1};
}

// Corners on steps of `grain` lattice steps within `cells` cells.
LatticeTriangle random_triangle(std::mt19937& random, int cells, int grain) {
    LatticeTriangle triangle;
    std::uniform_int_distribution<int> at(0, cells * kUnit / grain);
    for (glm::ivec3& corner : triangle)
        corner = glm::ivec3(at(random), at(random), at(random)) * grain;
    return triangle;
}

TEST(CoverTriangle, random_triangles_touch_the_cells_of_the_separating_axes) {
    std::mt19937 random(1);
    for (int i = 0; i < 150; ++i) {
        const LatticeTriangle triangle = random_triangle(random, 1 + i % 6, 1);
        EXPECT_EQ(covered(triangle, around(triangle)), touched(triangle, around(triangle))) << i;
    }
}

TEST(CoverTriangle, corners_and_edges_on_grid_planes_touch_the_cells_of_the_separating_axes) {
    std::mt19937 random(2);
    for (int i = 0; i < 300; ++i) {
        const LatticeTriangle triangle = random_triangle(random, 4, i % 2 == 0 ? kUnit : kUnit / 2);
        EXPECT_EQ(covered(triangle, around(triangle)), touched(triangle, around(triangle))) << i;
    }
}

TEST(CoverTriangle, closed_cells_would_touch_more) {
    std::mt19937 random(2);
    int different = 0;
    for (int i = 0; i < 50; ++i) {
        const LatticeTriangle triangle = random_triangle(random, 4, kUnit);
        const CellBox box = around(triangle);
        different += covered(triangle, box) != touched(triangle, box, 0) ? 1 : 0;
    }
    EXPECT_GT(different, 40);
}

TEST(CoverTriangle, points_and_segments_touch_the_cells_of_the_separating_axes) {
    std::mt19937 random(3);
    for (int i = 0; i < 100; ++i) {
        LatticeTriangle triangle = random_triangle(random, 4, i % 2 == 0 ? 1 : kUnit / 2);
        triangle[2] = i % 4 < 2 ? triangle[0] : (triangle[0] + triangle[1]) / 2;
        if (i % 10 == 0) triangle[1] = triangle[0];
        EXPECT_EQ(covered(triangle, around(triangle)), touched(triangle, around(triangle))) << i;
    }
}

TEST(CoverTriangle, moved_triangle_touches_other_cells) {
    const LatticeTriangle triangle = {{{100, 200, 300}, {9000, 5000, 700}, {3000, 12000, 8000}}};
    LatticeTriangle moved = triangle;
    moved[1].x += kUnit;
    EXPECT_EQ(covered(triangle, around(triangle)), touched(triangle, around(triangle)));
    EXPECT_NE(covered(moved, around(moved)), touched(triangle, around(triangle)));
}

// Triangles over 254 cells need the wide slab: rows near one place, not all.
TEST(CoverTriangle, large_triangles_touch_the_cells_of_the_separating_axes) {
    std::mt19937 random(4);
    std::uniform_real_distribution<double> part(0.0, 1.0);
    for (int i = 0; i < 60; ++i) {
        const LatticeTriangle triangle =
            random_triangle(random, i % 2 == 0 ? 700 : 60000, i % 3 == 0 ? kUnit : 1);
        const double a = part(random), b = part(random) * (1.0 - a);
        const glm::dvec3 at = glm::dvec3(triangle[0]) * a + glm::dvec3(triangle[1]) * b +
                              glm::dvec3(triangle[2]) * (1.0 - a - b);
        const glm::ivec3 cell = glm::ivec3(at) / kUnit;
        const CellBox box{glm::max(cell - 2, glm::ivec3(0)), cell + 2};
        const Cells cells = covered(triangle, box);
        EXPECT_FALSE(cells.empty());
        EXPECT_EQ(cells, touched(triangle, box)) << i;
    }
}

TEST(CoverTriangle, face_on_a_grid_plane_fills_one_layer) {
    const int at = 3 * kUnit;
    const LatticeTriangle triangle = {{{0, 0, at}, {8 * kUnit - 1, 0, at}, {0, 8 * kUnit - 1, at}}};
    for (const auto& [x, y, z] : covered(triangle, around(triangle)))
        EXPECT_EQ(z, 3);
}

TEST(CoverTriangle, thin_cells_are_among_those_touched) {
    std::mt19937 random(5);
    for (int i = 0; i < 200; ++i) {
        const LatticeTriangle triangle = random_triangle(random, 6, i % 2 == 0 ? 1 : kUnit / 2);
        const Cells cells = covered(triangle, around(triangle));
        for_each_crossing(triangle, around(triangle), [&](glm::ivec3 cell) {
            EXPECT_TRUE(cells.contains({cell.x, cell.y, cell.z})) << i;
        });
    }
}

TEST(CoverTriangle, wide_quotients_are_those_of_integers) {
    std::mt19937_64 random(6);
    for (int i = 0; i < 1000; ++i) {
        const auto b = static_cast<__int128>(random() >> (i % 50)) + 1;
        const auto a = b * static_cast<std::int32_t>(random()) + static_cast<__int128>(random() % 3) - 1;
        const __int128 q = floor_quotient(a, b);
        EXPECT_TRUE(q * b <= a && a < (q + 1) * b) << i;
    }
    EXPECT_EQ(floor_quotient(std::int64_t{-1}, std::int64_t{4096}), -1);
    EXPECT_EQ(floor_quotient(std::int64_t{-4096}, std::int64_t{4096}), -1);
}

}  // namespace
}  // namespace voxilux
