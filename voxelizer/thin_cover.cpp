#include "voxelizer/thin_cover.h"

namespace voxilux {
namespace {

// a u + b v >= bound for lines at (u + 1/2, v + 1/2) cells on the inner side of the edge through p.
HalfPlane edge_rule(std::int64_t a, std::int64_t b, glm::ivec2 p, bool owns_edge) {
    constexpr std::int64_t kHalf = kUnit / 2;
    return {a * kUnit, b * kUnit, a * (p.x - kHalf) + b * (p.y - kHalf) + (owns_edge ? 0 : 1)};
}

}  // namespace

LineCrossings::LineCrossings(const LatticeTriangle& triangle, int axis, bool is_closed) {
    const std::array<int, 3> order = {(axis + 1) % 3, (axis + 2) % 3, axis};
    std::array<glm::ivec3, 3> p;
    for (std::size_t i = 0; i < 3; ++i)
        p[i] = {triangle[i][order[0]], triangle[i][order[1]], triangle[i][order[2]]};
    const glm::i64vec3 e(p[1] - p[0]);
    const glm::i64vec3 f(p[2] - p[0]);
    area_ = e.x * f.y - e.y * f.x;
    if (area_ == 0) return;
    const int sign = facing();
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::i64vec3 d(p[(i + 1) % 3] - p[i]);
        const std::int64_t a = -sign * d.y;
        const std::int64_t b = sign * d.x;
        const bool owns_edge = is_closed || a > 0 || (a == 0 && b > 0);
        projection_.rules[i] = edge_rule(a, b, glm::ivec2(p[i]), owns_edge);
    }
    projection_.count = 3;
    normal_ = {static_cast<__int128>(sign) * (e.y * f.z - e.z * f.y),
               static_cast<__int128>(sign) * (e.z * f.x - e.x * f.z), static_cast<__int128>(sign) * area_};
    corner_ = p[0];
}

CellRange LineCrossings::cells_at(std::int32_t v, CellRange range) const {
    return projection_.cells_at(v, range);
}

std::int64_t LineCrossings::crossing(std::int32_t u, std::int32_t v) const {
    const std::int64_t du = std::int64_t{u} * kUnit + kUnit / 2 - corner_.x;
    const std::int64_t dv = std::int64_t{v} * kUnit + kUnit / 2 - corner_.y;
    return corner_.z + floor_quotient(-(normal_[0] * du + normal_[1] * dv), normal_[2]);
}

}  // namespace voxilux
