#include "world/sphere_tree.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "base/assert.h"
#include "base/error.h"
#include "scene/lobe_weights.h"
#include "world/sphere_view.h"

namespace voxilux {
namespace {

// Places of the planes of boxes on the grid of a node, beside the first.
constexpr int kGridSteps = 255;
// A part that is smaller than this share of a node is one of its children, not opened for more: on the node's
// grid, boxes of what it holds would be hardly smaller than its own.
constexpr double kSmallestOpened = 1.0 / 32.0;

// The sphere by its point nearest to the world's corner, which is computed in double.
gpu::SphereRecord sphere_record(const Sphere& sphere, glm::ivec3 origin) {
    const glm::dvec3 centre = sphere.centre - glm::dvec3(origin);
    const double distance = glm::length(centre);
    const glm::dvec3 normal = distance > 0.0 ? -centre / distance : glm::dvec3(0.0, 0.0, 1.0);
    const gpu::Sphere shape{glm::vec3(centre + sphere.radius * normal),
                            static_cast<float>(1.0 / sphere.radius), glm::vec3(normal)};
    return {shape, sphere.material};
}

gpu::SphereRecord ground_record(const Scene& scene, glm::ivec3 origin) {
    const double height = scene.ground.height.value_or(0.0) - origin.z;
    return {{.anchor = glm::vec3(0.0f, 0.0f, height), .curvature = 0.0f, .normal = glm::vec3(0, 0, 1)},
            static_cast<gpu::uint>(scene.materials.size())};
}

glm::uvec3 bits_of(glm::vec3 v) {
    return {std::bit_cast<gpu::uint>(v.x), std::bit_cast<gpu::uint>(v.y), std::bit_cast<gpu::uint>(v.z)};
}

gpu::SphereNode leaf_of(const gpu::Sphere& sphere, std::uint32_t number) {
    gpu::SphereNode leaf{};
    leaf.texels[0] = glm::uvec4(bits_of(sphere.anchor), number << 8u | gpu::kSphereLeaf);
    leaf.texels[1] = glm::uvec4(bits_of(sphere.normal), std::bit_cast<gpu::uint>(sphere.curvature));
    return leaf;
}

// The planes of children's boxes: corner + q 2^exponent, q from 0 to kGridSteps.
struct Grid {
    glm::vec3 corner;
    int exponent;
    double slack;  // by which boxes are larger, for what a walk rounds

    explicit Grid(const SphereBox& box) {
        const glm::dvec3 reach = glm::max(glm::abs(box.low), glm::abs(box.high));
        slack = double{gpu::kSphereSlack} * std::max({reach.x, reach.y, reach.z});
        corner = glm::vec3(box.low - 2.0 * slack);  // leaves room for its own rounding
        std::frexp((box.extent() + 4.0 * slack) / kGridSteps, &exponent);
        exponent = std::max(exponent, -126);
    }
    [[nodiscard]] double place(double at, int axis) const {
        return std::ldexp(at - static_cast<double>(corner[axis]), -exponent);
    }
};

std::uint32_t grid_byte(double place) {
    VX_ASSERT(place >= 0.0 && place <= kGridSteps);
    return static_cast<std::uint32_t>(place);
}

// Byte k of an axis, of low ends or of high ones.
void set_byte(gpu::SphereNode& node, bool is_high, int axis, std::uint32_t k, std::uint32_t byte) {
    const auto word = static_cast<std::uint32_t>(2 * axis) + (is_high ? 6u : 0u) + k / 4u;
    node.texels[1u + word / 4u][static_cast<int>(word % 4u)] |= byte << (8u * (k % 4u));
}

class TreePacker {
  public:
    TreePacker(std::span<const gpu::SphereRecord> spheres, SphereCut cut)
        : parts_(halve_spheres(spheres, cut)), spheres_(spheres), cut_(cut) {
        if (parts_.empty()) return;
        nodes.resize(1);
        pack(0, 0);
    }

    std::vector<gpu::SphereNode> nodes;

  private:
    using Children = std::vector<std::uint32_t>;  // places of parts

    void pack(std::size_t place, std::uint32_t part) {
        if (parts_[part].count == 1) {
            nodes[place] = leaf_of(spheres_[parts_[part].sphere].shape, parts_[part].sphere);
            return;
        }
        const Children children = in_octants(opened(part), parts_[part].box);
        const std::size_t first = nodes.size();
        nodes[place] = node_of(parts_[part].box, children, first);
        nodes.resize(first + children.size());
        for (std::size_t k = 0; k < children.size(); ++k)
            pack(first + k, children[k]);
    }

    // The children of a part: its halves, the largest of which are replaced by theirs.
    Children opened(std::uint32_t part) const {
        Children children(parts_[part].halves.begin(), parts_[part].halves.end());
        const double least = cut_ == SphereCut::by_cost ? kSmallestOpened * parts_[part].box.extent() : 0.0;
        const auto rank = [&](std::uint32_t child) {
            if (parts_[child].count == 1 || parts_[child].box.extent() < least) return -1.0;
            return cut_ == SphereCut::by_cost ? parts_[child].box.half_area() : parts_[child].count;
        };
        while (children.size() < gpu::kTreeWidth) {
            const auto largest = std::ranges::max_element(children, {}, rank);
            if (rank(*largest) < 0.0) break;
            const auto [one, other] = parts_[*largest].halves;
            *largest = one;
            children.push_back(other);
        }
        return children;
    }

    // Orders children so that number k is the first that a ray of octant k meets, as far as they go: of all
    // pairs of a child and a number, the best one is made first.
    Children in_octants(Children children, const SphereBox& box) const {
        const auto gain = [&](std::uint32_t child, std::size_t k) {
            const glm::dvec3 away = parts_[child].box.low + parts_[child].box.high - box.low - box.high;
            return (k & 1u ? away.x : -away.x) + (k & 2u ? away.y : -away.y) + (k & 4u ? away.z : -away.z);
        };
        Children placed(children.size());
        std::vector<std::size_t> numbers;
        for (std::size_t k = 0; k < children.size(); ++k)
            numbers.push_back(k);
        while (!numbers.empty()) {
            std::size_t best_child = 0;
            std::size_t best = 0;
            for (std::size_t c = 0; c < children.size(); ++c)
                for (std::size_t n = 0; n < numbers.size(); ++n)
                    if (gain(children[c], numbers[n]) > gain(children[best_child], numbers[best])) {
                        best_child = c;
                        best = n;
                    }
            placed[numbers[best]] = children[best_child];
            children.erase(children.begin() + static_cast<std::ptrdiff_t>(best_child));
            numbers.erase(numbers.begin() + static_cast<std::ptrdiff_t>(best));
        }
        return placed;
    }

    gpu::SphereNode node_of(const SphereBox& box, const Children& children, std::size_t first) const {
        if (first + children.size() > gpu::kMaxTreeNodes)
            throw Error(ExitCode::out_of_memory,
                        fmt::format("{} spheres need more than {} nodes of a hierarchy", spheres_.size(),
                                    gpu::kMaxTreeNodes));
        const Grid grid(box);
        const auto last = static_cast<std::uint32_t>(children.size() - 1);
        const auto biased = static_cast<std::uint32_t>(grid.exponent + 127);
        gpu::SphereNode node{};
        node.texels[0] =
            glm::uvec4(bits_of(grid.corner), static_cast<std::uint32_t>(first) << 11u | last << 8u | biased);
        for (std::uint32_t k = 0; k < children.size(); ++k) {
            const SphereBox& child = parts_[children[k]].box;
            for (int axis = 0; axis < 3; ++axis) {
                const double low = std::floor(grid.place(child.low[axis] - grid.slack, axis));
                const double high = std::ceil(grid.place(child.high[axis] + grid.slack, axis));
                set_byte(node, false, axis, k, grid_byte(low));
                set_byte(node, true, axis, k, grid_byte(high));
            }
        }
        return node;
    }

    std::vector<SpherePart> parts_;
    std::span<const gpu::SphereRecord> spheres_;
    SphereCut cut_;
};

std::uint32_t first_child(const gpu::SphereNode& node) {
    return node.texels[0].w >> 11u;
}

std::uint32_t child_count(const gpu::SphereNode& node) {
    return gpu::is_sphere_leaf(node) ? 0u : (node.texels[0].w >> 8u & 7u) + 1u;
}

// The box of a node's child.
SphereBox child_box(const gpu::SphereNode& node, std::uint32_t k) {
    const glm::uvec4 head = node.texels[0];
    const double step = std::ldexp(1.0, static_cast<int>(head.w & 255u) - 127);
    SphereBox box;
    for (int axis = 0; axis < 3; ++axis) {
        const auto plane = [&](bool is_high) {
            const auto word = static_cast<std::uint32_t>(2 * axis) + (is_high ? 6u : 0u) + k / 4u;
            const gpu::uint bytes = node.texels[1u + word / 4u][static_cast<int>(word % 4u)];
            return static_cast<double>(std::bit_cast<float>(head[axis])) +
                   step * static_cast<double>(gpu::byte_of(bytes, k % 4u));
        };
        box.low[axis] = plane(false);
        box.high[axis] = plane(true);
    }
    return box;
}

}  // namespace

std::vector<gpu::SphereRecord> sphere_records(const Scene& scene, glm::ivec3 origin) {
    std::vector<gpu::SphereRecord> records;
    for (const std::uint32_t number : sphere_order(scene))
        records.push_back(sphere_record(scene.spheres[number], origin));
    if (scene.ground.on) records.push_back(ground_record(scene, origin));
    return records;
}

std::vector<gpu::SphereNode> build_sphere_tree(std::span<const gpu::SphereRecord> spheres, SphereCut cut) {
    return std::move(TreePacker(spheres, cut).nodes);
}

std::uint32_t depth_of(std::span<const gpu::SphereNode> nodes) {
    std::uint32_t deepest = 0;
    std::vector<std::uint32_t> depths(nodes.size());
    for (std::size_t i = 0; i < nodes.size(); ++i) {  // children come after their node
        deepest = std::max(deepest, depths[i]);
        for (std::uint32_t k = 0; k < child_count(nodes[i]); ++k)
            depths[first_child(nodes[i]) + k] = depths[i] + 1;
    }
    return deepest;
}

std::vector<gpu::SphereNode> build_sphere_tree(std::span<const gpu::SphereRecord> spheres) {
    std::vector<gpu::SphereNode> nodes = build_sphere_tree(spheres, SphereCut::by_cost);
    if (depth_of(nodes) > gpu::kTreeStack + 1) nodes = build_sphere_tree(spheres, SphereCut::by_number);
    return nodes;
}

double mean_visits(std::span<const gpu::SphereNode> nodes) {
    if (nodes.empty()) return 0.0;
    SphereBox whole;
    double met = 0.0;
    for (const gpu::SphereNode& node : nodes) {
        for (std::uint32_t k = 0; k < child_count(node); ++k) {
            const SphereBox box = child_box(node, k);
            met += box.half_area();
            if (&node == &nodes.front()) whole.add(box);
        }
    }
    return met == 0.0 ? 1.0 : 1.0 + met / whole.half_area();
}

}  // namespace voxilux
