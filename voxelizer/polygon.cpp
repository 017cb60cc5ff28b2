#include "voxelizer/polygon.h"

#include <cmath>
#include <numeric>

namespace voxilux {
namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

// Twice the signed area of abc; positive for a left turn.
double turn(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// The corners projected along the axis on which the polygon's area is largest, counter-clockwise. Source:
// Newell's normal, in Sutherland, Sproull and Schumacker, 1974.
std::vector<glm::dvec2> flattened(std::span<const glm::dvec3> corners) {
    glm::dvec3 normal(0.0);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec3 a = corners[i] - corners[0], b = corners[(i + 1) % corners.size()] - corners[0];
        normal += glm::cross(a, b);
    }
    int axis = 0;
    for (int k = 1; k < 3; ++k) {
        if (std::abs(normal[k]) > std::abs(normal[axis])) axis = k;
    }
    const double sign = normal[axis] < 0.0 ? -1.0 : 1.0;
    std::vector<glm::dvec2> flat;
    for (const glm::dvec3& p : corners)
        flat.emplace_back(p[(axis + 1) % 3], sign * p[(axis + 2) % 3]);
    return flat;
}

Triangles fan(std::size_t corners) {
    Triangles triangles;
    for (std::uint32_t i = 2; i < corners; ++i)
        triangles.push_back({0, i - 1, i});
    return triangles;
}

bool is_convex(const std::vector<glm::dvec2>& flat) {
    for (std::size_t i = 0; i < flat.size(); ++i) {
        if (turn(flat[i], flat[(i + 1) % flat.size()], flat[(i + 2) % flat.size()]) < 0.0) return false;
    }
    return true;
}

// Whether corner i of the ring, the remaining corners, can be cut off without cutting others.
bool is_ear(const std::vector<glm::dvec2>& flat, const std::vector<std::uint32_t>& ring, std::size_t i) {
    const std::size_t n = ring.size();
    const glm::dvec2 a = flat[ring[(i + n - 1) % n]], b = flat[ring[i]], c = flat[ring[(i + 1) % n]];
    if (turn(a, b, c) <= 0.0) return false;
    for (const std::uint32_t other : ring) {
        const glm::dvec2 p = flat[other];
        if (p == a || p == b || p == c) continue;
        if (turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0) return false;
    }
    return true;
}

Triangles clip_ears(const std::vector<glm::dvec2>& flat) {
    Triangles triangles;
    std::vector<std::uint32_t> ring(flat.size());
    std::iota(ring.begin(), ring.end(), 0u);
    std::size_t at = 0;      // next corner to try
    std::size_t failed = 0;  // consecutive corners that are no ears
    while (ring.size() > 3 && failed < ring.size()) {
        const std::size_t n = ring.size();
        at %= n;
        if (!is_ear(flat, ring, at)) {
            ++at;
            ++failed;
            continue;
        }
        triangles.push_back({ring[(at + n - 1) % n], ring[at], ring[(at + 1) % n]});
        ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(at));
        failed = 0;
    }
    for (std::size_t i = 2; i < ring.size(); ++i)
        triangles.push_back({ring[0], ring[i - 1], ring[i]});
    return triangles;
}

}  // namespace

Triangles triangulate(std::span<const glm::dvec3> corners) {
    if (corners.size() < 4 || corners.size() > kMaxEarCorners) return fan(corners.size());
    const std::vector<glm::dvec2> flat = flattened(corners);
    return is_convex(flat) ? fan(corners.size()) : clip_ears(flat);
}

}  // namespace voxilux
