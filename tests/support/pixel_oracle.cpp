#include "support/pixel_oracle.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>

namespace voxilux::test {
namespace {

struct Crossing {
    double enter = 0.0;
    double leave = std::numeric_limits<double>::infinity();
};

std::optional<Crossing> cross_box(const DoubleRay& ray, glm::dvec3 lo, glm::dvec3 hi) {
    Crossing crossing;
    for (int a = 0; a < 3; ++a) {
        const double d = ray.direction[a];
        if (d == 0.0) {
            if (ray.origin[a] < lo[a] || ray.origin[a] > hi[a]) return std::nullopt;
            continue;
        }
        const double t0 = (lo[a] - ray.origin[a]) / d;
        const double t1 = (hi[a] - ray.origin[a]) / d;
        crossing.enter = std::max(crossing.enter, std::min(t0, t1));
        crossing.leave = std::min(crossing.leave, std::max(t0, t1));
    }
    if (crossing.enter > crossing.leave) return std::nullopt;
    return crossing;
}

// Entry of the first box that stops the ray even when all boxes are shrunk; infinity when there is none.
double sure_stop(const std::vector<glm::ivec3>& solids, const DoubleRay& ray, double margin) {
    double first = std::numeric_limits<double>::infinity();
    for (const glm::ivec3& cell : solids) {
        const auto crossing = cross_box(ray, glm::dvec3(cell) + margin, glm::dvec3(cell) + (1.0 - margin));
        if (crossing) first = std::min(first, crossing->enter);
    }
    return first;
}

std::string face_disagreement(const DoubleRay& ray, const gpu::Hit& hit, double margin) {
    const int axis = static_cast<int>(hit.face >> 1u);
    const double outward = (hit.face & 1u) != 0 ? 1.0 : -1.0;
    if (!(ray.direction[axis] * outward < 0.0))
        return fmt::format("face {} looks away from the ray", hit.face);
    const double fraction = static_cast<double>(hit.fraction[axis]);
    if (fraction != static_cast<double>(hit.face & 1u))
        return fmt::format("fraction {} off the face", fraction);
    const glm::dvec3 point = glm::dvec3(hit.cell) + glm::dvec3(hit.fraction);
    const double t = (point[axis] - ray.origin[axis]) / ray.direction[axis];
    const glm::dvec3 away = ray.origin + t * ray.direction - point;
    const double error = std::max({std::abs(away.x), std::abs(away.y), std::abs(away.z)});
    return error <= margin ? "" : fmt::format("point {} voxels off the ray", error);
}

}  // namespace

DoubleRay to_double(const gpu::Ray& ray) {
    return {glm::dvec3(ray.cell) + glm::dvec3(ray.fraction), glm::dvec3(ray.direction)};
}

std::string hit_disagreement(const std::vector<glm::ivec3>& solids, const DoubleRay& ray, const gpu::Hit& hit,
                             double margin, double t_margin) {
    const double stop = sure_stop(solids, ray, margin);
    if (hit.face == gpu::kFaceMiss)
        return stop < std::numeric_limits<double>::infinity() ? fmt::format("missed a voxel at {}", stop)
                                                              : "";
    if (std::ranges::find(solids, hit.cell) == solids.end()) return "hit an empty cell";
    if (hit.face == gpu::kFaceInside) {
        const bool holds_origin = glm::ivec3(glm::floor(ray.origin)) == hit.cell;
        return holds_origin && hit.t == 0.0f ? "" : "inside, but the ray does not start there at 0";
    }
    const auto grown = cross_box(ray, glm::dvec3(hit.cell) - margin, glm::dvec3(hit.cell) + (1.0 + margin));
    if (!grown) return "hit a voxel that the ray does not touch";
    // A grazing ray crosses a sliver of the margin slowly, so only an entry behind a certain stop is wrong.
    if (grown->enter > stop + 4.0 * margin)
        return fmt::format("hit at {}, behind a voxel at {}", grown->enter, stop);
    const double t = static_cast<double>(hit.t);
    if (t < grown->enter - t_margin || t > grown->leave + t_margin)
        return fmt::format("t {} outside [{}, {}]", t, grown->enter, grown->leave);
    return face_disagreement(ray, hit, margin);
}

}  // namespace voxilux::test
