#include "voxelizer/cover_triangle.h"

namespace voxilux {
namespace {

// The largest extent of a triangle and a cell together, in lattice steps, so that 6 extent^3 stays below
// 2^63.
constexpr std::int64_t kNarrowExtent = std::int64_t{1} << 20;

// A quotient beyond any cell; the wide division saturates there.
constexpr std::int64_t kFarQuotient = std::int64_t{1} << 40;

// a (u unit + [a > 0] unit - p) + b (...) >= 0 for the cell's corner farthest along (a, b), written for u, v.
HalfPlane half_plane(std::int64_t a, std::int64_t b, glm::ivec2 p, std::int64_t unit) {
    const bool is_strict = a > 0 || b > 0;  // the corner is not part of the cell
    const std::int64_t bound = a * (p.x - (a > 0 ? unit : 0)) + b * (p.y - (b > 0 ? unit : 0));
    return {a * unit, b * unit, bound + (is_strict ? 1 : 0)};
}

PlaneProjection project(const LatticeTriangle& triangle, int u, int v, std::int64_t unit) {
    std::array<glm::ivec2, 3> p;
    for (std::size_t i = 0; i < 3; ++i)
        p[i] = {triangle[i][u], triangle[i][v]};
    const auto side = [&](std::size_t i) { return glm::i64vec2(p[(i + 1) % 3] - p[i]); };
    const glm::i64vec2 e = side(0);
    const glm::i64vec2 f = side(1);
    const std::int64_t area = e.x * f.y - e.y * f.x;
    PlaneProjection result;
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::i64vec2 d = side(i);
        const auto add = [&](std::int64_t sign) {
            result.rules[static_cast<std::size_t>(result.count++)] =
                half_plane(-sign * d.y, sign * d.x, p[i], unit);
        };
        if (area >= 0) add(1);
        if (area <= 0) add(-1);
    }
    return result;
}

template <class T>
Slab<T> slab_of(const LatticeTriangle& triangle, glm::ivec3 origin, std::int64_t unit) {
    const auto at = [&](std::size_t corner, int axis) { return static_cast<T>(triangle[corner][axis]); };
    std::array<T, 3> n;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const int u = static_cast<int>((axis + 1) % 3);
        const int v = static_cast<int>((axis + 2) % 3);
        n[axis] =
            (at(1, u) - at(0, u)) * (at(2, v) - at(0, v)) - (at(1, v) - at(0, v)) * (at(2, u) - at(0, u));
    }
    const T sign = n[0] < 0 ? -1 : 1;
    Slab<T> slab{.origin = origin};
    int tilted = 0;
    bool rises = false;
    bool falls = false;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const int a = static_cast<int>(axis);
        const T along = sign * n[axis];
        const T from = static_cast<T>(origin[a]) * unit - at(0, a);  // of the cell's low corner
        slab.step[axis] = along * unit;
        slab.low += along * (from + (along > 0 ? unit : 0));
        slab.high += along * (from + (along < 0 ? unit : 0));
        rises = rises || along > 0;
        falls = falls || along < 0;
        tilted += along != 0 ? 1 : 0;
    }
    slab.low_bound = rises ? 1 : 0;
    slab.high_bound = falls ? -1 : 0;
    slab.is_needed = tilted > 1;
    return slab;
}

}  // namespace

std::int64_t floor_quotient(std::int64_t a, std::int64_t b) {
    return a / b - (a % b < 0 ? 1 : 0);
}

std::int64_t floor_quotient(__int128 a, __int128 b) {
    const double estimate = static_cast<double>(a) / static_cast<double>(b);
    if (!(std::abs(estimate) < static_cast<double>(kFarQuotient)))
        return estimate < 0.0 ? -kFarQuotient : kFarQuotient;
    // Below 2^40 the estimate is off by less than one, before and after rounding.
    auto quotient = static_cast<std::int64_t>(std::floor(estimate));
    __int128 rest = a - b * quotient;
    for (; rest < 0; rest += b)
        --quotient;
    for (; rest >= b; rest -= b)
        ++quotient;
    return quotient;
}

CellBox cell_box(const LatticeTriangle& triangle, std::int32_t unit) {
    const auto [a, b, c] = triangle;
    return {glm::min(glm::min(a, b), c) / unit, glm::max(glm::max(a, b), c) / unit};
}

CellRange PlaneProjection::cells_at(std::int32_t v, CellRange range) const {
    std::int64_t first = range.first;
    std::int64_t last = range.last;
    for (int i = 0; i < count; ++i) {
        const HalfPlane& rule = rules[static_cast<std::size_t>(i)];
        const std::int64_t least = rule.bound - rule.b * v;  // a u >= least
        if (rule.a > 0) {
            first = std::max(first, -floor_quotient(-least, rule.a));
        } else if (rule.a < 0) {
            last = std::min(last, floor_quotient(-least, -rule.a));
        } else if (least > 0) {
            return {};
        }
    }
    return inside(range, first, last);
}

TriangleCover cover_of(const LatticeTriangle& triangle, std::int32_t unit) {
    TriangleCover cover{.box = cell_box(triangle, unit)};
    const glm::ivec3 span = cover.box.high - cover.box.low;
    if (span == glm::ivec3(0)) return cover;
    cover.xy = project(triangle, 0, 1, unit);
    cover.xz = project(triangle, 0, 2, unit);
    cover.yz = project(triangle, 1, 2, unit);
    const std::int64_t extent = (std::int64_t{std::max({span.x, span.y, span.z})} + 2) * unit;
    cover.is_wide = extent > kNarrowExtent;
    if (cover.is_wide) {
        cover.wide_slab = slab_of<__int128>(triangle, cover.box.low, unit);
        cover.slab.is_needed = cover.wide_slab.is_needed;
    } else {
        cover.slab = slab_of<std::int64_t>(triangle, cover.box.low, unit);
    }
    return cover;
}

}  // namespace voxilux
