#include "voxelizer/cell_piece.h"

#include <algorithm>
#include <cmath>

namespace voxilux {
namespace {

// Below this area, in voxels^2, a centroid is a quotient of rounding errors.
constexpr float kTinyArea = 1e-9f;

void add(ConvexPolygon& polygon, glm::vec3 corner) {
    if (polygon.count <= kMaxCorners) polygon.corners[static_cast<std::size_t>(polygon.count++)] = corner;
}

// The parts of `whole` below and above a plane across an axis; corners on the plane belong to both.
template <int kAxis>
void split(const ConvexPolygon& whole, float at, ConvexPolygon& below, ConvexPolygon& above) {
    below.count = 0;
    above.count = 0;
    if (whole.count == 0) return;
    glm::vec3 from = whole.corners[static_cast<std::size_t>(whole.count - 1)];
    float d_from = from[kAxis] - at;
    for (int i = 0; i < whole.count; ++i) {
        const glm::vec3 to = whole.corners[static_cast<std::size_t>(i)];
        const float d_to = to[kAxis] - at;
        if ((d_from < 0.0f) != (d_to < 0.0f) && d_from != 0.0f && d_to != 0.0f) {
            glm::vec3 crossing = from + (to - from) * (d_from / (d_from - d_to));
            crossing[kAxis] = at;
            add(below, crossing);
            add(above, crossing);
        }
        if (d_to <= 0.0f) add(below, to);
        if (d_to >= 0.0f) add(above, to);
        from = to;
        d_from = d_to;
    }
}

template <int kAxis>
ConvexPolygon slab(const ConvexPolygon& whole, float low, float high, bool cut_low, bool cut_high) {
    ConvexPolygon outside;
    ConvexPolygon upper;
    if (cut_low) split<kAxis>(whole, low, outside, upper);
    if (!cut_high) return cut_low ? upper : whole;
    ConvexPolygon inside;
    split<kAxis>(cut_low ? upper : whole, high, inside, outside);
    return inside;
}

float cross(glm::vec3 a, glm::vec3 b, int u, int v) {
    return a[u] * b[v] - a[v] * b[u];
}

}  // namespace

std::array<glm::vec3, 2> barycentric_slopes(glm::vec3 edge_b, glm::vec3 edge_c) {
    const glm::vec3 normal = glm::cross(edge_b, edge_c);
    const float square = glm::dot(normal, normal);
    if (!(square > 0.0f)) return {};
    return {glm::cross(edge_c, normal) / square, glm::cross(normal, edge_b) / square};
}

PieceCutter::PieceCutter(const std::array<glm::vec3, 3>& triangle) : triangle_(triangle) {
    const auto& [a, b, c] = triangle_;
    low_ = glm::min(glm::min(a, b), c);
    high_ = glm::max(glm::max(a, b), c);
    const glm::vec3 normal = glm::cross(b - a, c - a);
    const glm::vec3 size = glm::abs(normal);
    const int across = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
    u_ = (across + 1) % 3;
    v_ = (across + 2) % 3;
    area_ = 0.5f * glm::length(normal);
    stretch_ = area_ > kTinyArea ? area_ / size[across] : 0.0f;
}

void PieceCutter::begin_row(int y, int z) {
    row_ = {y, z};
    if (z != slab_z_) {
        slab_z_ = z;
        slab_.count = 3;
        std::ranges::copy(triangle_, slab_.corners.begin());
        const auto low = static_cast<float>(z);
        slab_ = slab<2>(slab_, low, low + 1.0f, low_.z<low, high_.z> low + 1.0f);
    }
    const auto low = static_cast<float>(y);
    rest_ = slab<1>(slab_, low, low + 1.0f, low_.y<low, high_.y> low + 1.0f);
    rest_from_ = low_.x;
}

CellPiece PieceCutter::next_cell(int x) {
    const auto low = static_cast<float>(x);
    if (rest_from_ < low) {
        ConvexPolygon outside;
        const ConvexPolygon whole = rest_;
        split<0>(whole, low, outside, rest_);
    }
    rest_from_ = low + 1.0f;
    CellPiece piece;
    if (high_.x > low + 1.0f) {
        ConvexPolygon cell;
        ConvexPolygon rest;
        split<0>(rest_, low + 1.0f, cell, rest);
        piece = measure(cell);
        rest_ = rest;
    } else {
        piece = measure(rest_);
        rest_.count = 0;  // a triangle that ends on the next cell's face touches that cell in no area
    }
    if (piece.area == 0.0f) piece.centre = point_near(glm::vec3(x, row_.x, row_.y) + 0.5f);
    return piece;
}

CellPiece PieceCutter::measure(const ConvexPolygon& polygon) const {
    if (polygon.count < 3) return {};
    const glm::vec3 origin = polygon.corners[0];
    float twice = 0.0f;
    glm::vec3 moment(0.0f);
    glm::vec3 from = polygon.corners[1] - origin;
    for (int i = 2; i < polygon.count; ++i) {
        const glm::vec3 to = polygon.corners[static_cast<std::size_t>(i)] - origin;
        const float part = cross(from, to, u_, v_);
        twice += part;
        moment += (from + to) * part;
        from = to;
    }
    const float area = std::abs(twice) * stretch_;
    if (!(area > kTinyArea)) return {};
    return {area, origin + moment / (3.0f * twice)};
}

// The point for a cell that is barely touched: its centre moved onto the triangle along the axis it faces.
glm::vec3 PieceCutter::point_near(glm::vec3 p) const {
    const auto& [a, b, c] = triangle_;
    const float whole = cross(b - a, c - a, u_, v_);
    if (stretch_ == 0.0f || whole == 0.0f) return (a + b + c) / 3.0f;
    const float at_b = std::max(0.0f, cross(p - a, c - a, u_, v_) / whole);
    const float at_c = std::max(0.0f, cross(b - a, p - a, u_, v_) / whole);
    const float at_a = std::max(0.0f, 1.0f - at_b - at_c);
    return (a * at_a + b * at_b + c * at_c) / (at_a + at_b + at_c);
}

}  // namespace voxilux
