#include "world/sphere_tree.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "base/checked_cast.h"
#include "scene/lobe_weights.h"

namespace voxilux {
namespace {

// Relative to a sphere's coordinates: bounds the rounding of its record, where the anchor is small but the
// centre may be large.
constexpr double kRecordError = 1.0e-6;
// Splits by cost may be lopsided. From this depth on, halves are equal, so recursion ends soon.
constexpr int kMostLopsided = 64;

struct Bounds {
    glm::dvec3 low{std::numeric_limits<double>::infinity()};
    glm::dvec3 high{-std::numeric_limits<double>::infinity()};

    void add(const Bounds& other) {
        low = glm::min(low, other.low);
        high = glm::max(high, other.high);
    }
    [[nodiscard]] double half_area() const {
        const glm::dvec3 e = high - low;
        return e.x * e.y + e.y * e.z + e.z * e.x;
    }
};

Bounds bounds_of(const gpu::Sphere& sphere) {
    if (sphere.curvature == 0.0f) {
        const glm::dvec3 end(gpu::kFarthestGround, gpu::kFarthestGround, 0.0);
        return {glm::dvec3(sphere.anchor) - end, glm::dvec3(sphere.anchor) + end};
    }
    const double radius = 1.0 / static_cast<double>(sphere.curvature);
    const glm::dvec3 centre = glm::dvec3(sphere.anchor) - radius * glm::dvec3(sphere.normal);
    const glm::dvec3 reach = radius + kRecordError * (glm::abs(centre) + radius);
    return {centre - reach, centre + reach};
}

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

class TreeBuilder {
  public:
    explicit TreeBuilder(std::span<const gpu::SphereRecord> spheres) : order_(spheres.size()) {
        for (const gpu::SphereRecord& sphere : spheres)
            bounds_.push_back(bounds_of(sphere.shape));
        std::iota(order_.begin(), order_.end(), 0u);
        nodes.reserve(2 * spheres.size());
        if (!spheres.empty()) add_node(order_, 0);
    }

    std::vector<gpu::SphereNode> nodes;

  private:
    using Part = std::span<std::uint32_t>;

    void add_node(Part part, int depth) {
        Bounds box;
        for (const std::uint32_t i : part)
            box.add(bounds_[i]);
        const std::size_t number = nodes.size();
        nodes.push_back({.low = glm::vec3(box.low),
                         .next = 0,
                         .high = glm::vec3(box.high),
                         .sphere = part.size() == 1 ? part.front() : gpu::kNoSphere});
        if (part.size() > 1) {
            const std::size_t first = split(part, depth);
            add_node(part.first(first), depth + 1);
            add_node(part.subspan(first), depth + 1);
        }
        nodes[number].next = checked_cast<std::uint32_t>(nodes.size(), "nodes over spheres");
    }

    void sort(Part part, int axis) {
        std::sort(part.begin(), part.end(), [&](std::uint32_t a, std::uint32_t b) {
            const double at_a = bounds_[a].low[axis] + bounds_[a].high[axis];
            const double at_b = bounds_[b].low[axis] + bounds_[b].high[axis];
            return at_a != at_b ? at_a < at_b : a < b;
        });
    }

    // Orders a part so that the two halves cost a ray the least (surface area heuristic). Returns the size of
    // the first.
    std::size_t split(Part part, int depth) {
        double least = std::numeric_limits<double>::infinity();
        std::size_t first = part.size() / 2;
        int best = 0;
        for (int axis = 0; axis < 3; ++axis) {
            sort(part, axis);
            const auto [cost, size] = cheapest_cut(part);
            if (cost >= least) continue;
            least = cost;
            best = axis;
            first = size;
        }
        if (best != 2) sort(part, best);
        return depth < kMostLopsided ? first : part.size() / 2;
    }

    struct Cut {
        double cost;
        std::size_t first;
    };

    Cut cheapest_cut(Part part) {
        std::vector<double> behind(part.size());
        Bounds box;
        for (std::size_t i = part.size(); i-- > 1;) {
            box.add(bounds_[part[i]]);
            behind[i] = box.half_area();
        }
        Cut cut{std::numeric_limits<double>::infinity(), part.size() / 2};
        box = {};
        for (std::size_t i = 1; i < part.size(); ++i) {
            box.add(bounds_[part[i - 1]]);
            const double cost =
                box.half_area() * static_cast<double>(i) + behind[i] * static_cast<double>(part.size() - i);
            if (cost < cut.cost) cut = {cost, i};
        }
        return cut;
    }

    std::vector<Bounds> bounds_;
    std::vector<std::uint32_t> order_;
};

double half_area(const gpu::SphereNode& node) {
    return Bounds{glm::dvec3(node.low), glm::dvec3(node.high)}.half_area();
}

}  // namespace

std::vector<gpu::SphereRecord> sphere_records(const Scene& scene, glm::ivec3 origin) {
    std::vector<gpu::SphereRecord> records;
    for (const std::uint32_t number : sphere_order(scene))
        records.push_back(sphere_record(scene.spheres[number], origin));
    if (scene.ground.on) records.push_back(ground_record(scene, origin));
    return records;
}

std::vector<gpu::SphereNode> build_sphere_tree(std::span<const gpu::SphereRecord> spheres) {
    return std::move(TreeBuilder(spheres).nodes);
}

double mean_visits(std::span<const gpu::SphereNode> nodes) {
    if (nodes.empty()) return 0.0;
    double met = 0.0;
    for (const gpu::SphereNode& node : nodes)
        if (node.sphere == gpu::kNoSphere) met += half_area(node);
    return 1.0 + 2.0 * met / half_area(nodes.front());
}

}  // namespace voxilux
