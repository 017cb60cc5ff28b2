#pragma once

// The part of a triangle inside a cell: its area and its centroid. The triangle is cut into slabs of z, these
// into rows of y, and a row into cells, so that each cut is shared by everything behind it. Weights need not
// be exact (which cells are touched is decided elsewhere), so this uses floats, in the space of a block.

#include <array>

#include <glm/glm.hpp>

namespace voxilux {

// A triangle cut by the six planes of a cell has at most nine corners.
inline constexpr int kMaxCorners = 9;

struct ConvexPolygon {
    std::array<glm::vec3, kMaxCorners + 1> corners;
    int count = 0;
};

struct CellPiece {
    float area = 0.0f;       // voxels^2; 0 where the triangle only touches the cell
    glm::vec3 centre{0.0f};  // on the triangle
};

// The gradients of the second and the third barycentric coordinate of a triangle with these edges from its
// first corner; zero for a triangle without area.
[[nodiscard]] std::array<glm::vec3, 2> barycentric_slopes(glm::vec3 edge_b, glm::vec3 edge_c);

// Cuts one triangle. Rows must be requested with ascending z, then ascending y, and cells with ascending x,
// all within the triangle's bounding box.
class PieceCutter {
  public:
    explicit PieceCutter(const std::array<glm::vec3, 3>& triangle);

    void begin_row(int y, int z);
    [[nodiscard]] CellPiece next_cell(int x);

    [[nodiscard]] float area() const { return area_; }

  private:
    [[nodiscard]] CellPiece measure(const ConvexPolygon& polygon) const;
    [[nodiscard]] glm::vec3 point_near(glm::vec3 p) const;

    std::array<glm::vec3, 3> triangle_;
    glm::vec3 low_, high_;
    int u_ = 0;  // the two axes along which the triangle is widest
    int v_ = 1;
    float stretch_ = 0.0f;  // area on the triangle per area in (u, v), halved
    float area_ = 0.0f;
    int slab_z_ = -1;
    glm::ivec2 row_{0};
    ConvexPolygon slab_, rest_;
    float rest_from_ = 0.0f;  // x up to which `rest_` has been handed out
};

}  // namespace voxilux
