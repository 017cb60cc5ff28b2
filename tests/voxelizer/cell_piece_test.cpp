#include "voxelizer/cell_piece.h"

#include <gtest/gtest.h>

namespace voxilux {
namespace {

// A right triangle of area 1/2 that reaches from 1 to 2 on both axes of its plane.
std::array<glm::vec3, 3> half_square(int normal_axis) {
    std::array<glm::vec3, 3> corners{glm::vec3(1.0f), glm::vec3(1.0f), glm::vec3(1.0f)};
    corners[1][(normal_axis + 1) % 3] = 2.0f;
    corners[2][(normal_axis + 2) % 3] = 2.0f;
    for (glm::vec3& corner : corners)
        corner[normal_axis] = 1.25f;
    return corners;
}

// The area of a triangle that ends on a cell's face counts in the cell that it fills and in none that it
// touches.
TEST(CellPiece, triangle_that_ends_on_a_face_has_no_area_behind_it) {
    for (int axis = 0; axis < 3; ++axis) {
        PieceCutter cutter(half_square(axis));
        float sum = 0.0f;
        for (int z = 1; z <= 2; ++z)
            for (int y = 1; y <= 2; ++y) {
                cutter.begin_row(y, z);
                for (int x = 1; x <= 2; ++x) {
                    const float area = cutter.next_cell(x).area;
                    EXPECT_EQ(area, x == 1 && y == 1 && z == 1 ? 0.5f : 0.0f) << axis << x << y << z;
                    sum += area;
                }
            }
        EXPECT_EQ(sum, cutter.area());
    }
}

}  // namespace
}  // namespace voxilux
