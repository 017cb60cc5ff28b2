#include "voxelizer/winding_number.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/checked_cast.h"

namespace voxilux {
namespace {

constexpr std::uint32_t kLeafTriangles = 8;
// Distance, in radii of a node, from which on the node counts as one dipole.
constexpr double kFarRadii = 4.0;
// The tree halves its triangles, 2^32 at most, so a traversal never has more nodes open.
constexpr std::size_t kMaxOpen = 64;

// Source: A. van Oosterom and J. Strackee, "The Solid Angle of a Plane Triangle", 1983.
double solid_angle(glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
    const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
    return 2.0 * std::atan2(glm::dot(a, glm::cross(b, c)),
                            la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb);
}

}  // namespace

WindingTree::WindingTree(const Mesh& mesh, std::span<const std::uint32_t> triangles,
                         std::span<const glm::ivec3> lattice) {
    const auto place = [&](std::uint32_t vertex) { return glm::dvec3(lattice[vertex]) / double{kUnit}; };
    for (const std::uint32_t index : triangles) {
        const glm::uvec3 v = mesh.triangles[index].vertices;
        triangles_.push_back({place(v.x), place(v.y), place(v.z)});
    }
    build(0, checked_cast<std::uint32_t>(triangles_.size(), "triangles"));
}

WindingTree::Node WindingTree::summed(std::uint32_t first, std::uint32_t count) const {
    Node node{.first = first, .count = count};
    const auto own = std::span(triangles_).subspan(first, count);
    double area = 0.0;
    glm::dvec3 moment(0.0), mean(0.0);
    for (const Triangle& t : own) {
        const glm::dvec3 normal = 0.5 * glm::cross(t.b - t.a, t.c - t.a);
        const glm::dvec3 centroid = (t.a + t.b + t.c) / 3.0;
        node.area_vector += normal;
        area += glm::length(normal);
        moment += glm::length(normal) * centroid;
        mean += centroid / static_cast<double>(count);
    }
    node.centre = area > 0.0 ? moment / area : mean;
    for (const Triangle& t : own) {
        for (const glm::dvec3 corner : {t.a, t.b, t.c})
            node.radius = std::max(node.radius, glm::distance(corner, node.centre));
    }
    return node;
}

// Recursion halves the triangles: its depth is that of a balanced tree.
void WindingTree::build(std::uint32_t first, std::uint32_t count) {
    const std::size_t own = nodes_.size();
    nodes_.push_back(summed(first, count));
    if (count <= kLeafTriangles) return;
    glm::dvec3 low(INFINITY), high(-INFINITY);
    const auto own_triangles = std::span(triangles_).subspan(first, count);
    for (const Triangle& t : own_triangles) {
        low = glm::min(low, t.a + t.b + t.c);
        high = glm::max(high, t.a + t.b + t.c);
    }
    const glm::dvec3 extent = high - low;
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
    const std::uint32_t half = count / 2;
    std::ranges::nth_element(own_triangles, own_triangles.begin() + half, {},
                             [&](const Triangle& t) { return t.a[axis] + t.b[axis] + t.c[axis]; });
    build(first, half);
    nodes_[own].second = checked_cast<std::uint32_t>(nodes_.size(), "nodes");
    build(first + half, count - half);
}

double WindingTree::at(glm::dvec3 point) const {
    std::array<std::uint32_t, kMaxOpen> open{};
    std::size_t count = 1;
    double sum = 0.0;
    while (count > 0) {
        const std::uint32_t index = open[--count];
        const Node& node = nodes_[index];
        const glm::dvec3 towards = node.centre - point;
        const double distance = glm::length(towards);
        if (distance > kFarRadii * node.radius && distance > 0.0) {
            sum += glm::dot(node.area_vector, towards) / (distance * distance * distance);
        } else if (node.second != 0) {
            open[count++] = index + 1;
            open[count++] = node.second;
        } else {
            for (const Triangle& t : std::span(triangles_).subspan(node.first, node.count))
                sum += solid_angle(t.a - point, t.b - point, t.c - point);
        }
    }
    return sum / (4.0 * std::numbers::pi);
}

}  // namespace voxilux
