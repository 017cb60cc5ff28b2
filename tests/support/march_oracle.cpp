#include "support/march_oracle.h"

#include <fmt/format.h>
#include <algorithm>

#include <limits>

namespace voxilux::test {

namespace {

struct Interval {
    double enter = 0.0;
    double leave = std::numeric_limits<double>::infinity();
};

std::optional<Interval> box_interval(const gpu::Ray& ray, glm::dvec3 lo, glm::dvec3 hi) {
    const glm::dvec3 origin = glm::dvec3(ray.cell) + glm::dvec3(ray.fraction);
    Interval interval;
    for (int a = 0; a < 3; ++a) {
        const double d = static_cast<double>(ray.direction[a]);
        if (d == 0.0) {
            if (origin[a] < lo[a] || origin[a] > hi[a]) return std::nullopt;
            continue;
        }
        const double t0 = (lo[a] - origin[a]) / d;
        const double t1 = (hi[a] - origin[a]) / d;
        interval.enter = std::max(interval.enter, std::min(t0, t1));
        interval.leave = std::min(interval.leave, std::max(t0, t1));
    }
    if (interval.enter > interval.leave) return std::nullopt;
    return interval;
}

}  // namespace

OracleBounds oracle_bounds(const std::vector<glm::ivec3>& solids, const gpu::Ray& ray, double margin) {
    OracleBounds bounds;
    for (const glm::ivec3& cell : solids) {
        const glm::dvec3 lo(cell);
        const glm::dvec3 hi = lo + 1.0;
        if (const auto shrunk = box_interval(ray, lo + margin, hi - margin)) {
            if (!bounds.must_by || shrunk->enter < *bounds.must_by) bounds.must_by = shrunk->enter;
        }
        if (const auto grown = box_interval(ray, lo - margin, hi + margin))
            bounds.may.emplace_back(cell, grown->enter);
    }
    return bounds;
}

std::string disagreement(const OracleBounds& bounds, const gpu::Ray& ray, const gpu::MarchHit& hit,
                         double margin) {
    const double t_max = static_cast<double>(ray.t_max);
    const double t = static_cast<double>(hit.t);
    if (hit.face == gpu::kFaceMiss) {
        if (bounds.must_by && *bounds.must_by < t_max - 4.0 * margin)
            return fmt::format("missed a solid that stops the ray at {}", *bounds.must_by);
        return "";
    }
    // On a grazing ray, a box shrunk by `margin` may be entered arbitrarily late, so only an earlier stop is
    // a fault.
    if (bounds.must_by && t > *bounds.must_by + 4.0 * margin)
        return fmt::format("hit at {} but a solid stops the ray at {}", t, *bounds.must_by);
    for (const auto& [cell, enter] : bounds.may) {
        if (cell == hit.cell && t + 4.0 * margin >= enter) return "";
    }
    return fmt::format("hit cell ({}, {}, {}) at {}, which the ray does not touch", hit.cell.x, hit.cell.y,
                       hit.cell.z, t);
}

std::vector<glm::ivec3> solid_cells(const VoxelWorld& world) {
    std::vector<glm::ivec3> cells;
    world.for_each_voxel([&](glm::ivec3 cell, std::uint16_t) { cells.push_back(cell); });
    return cells;
}

}  // namespace voxilux::test
