#include "world/sphere_halves.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "shared/limits.h"

namespace voxilux {
namespace {

// Of a sphere's coordinates: the rounding of its record, where an anchor is small and a centre may be large.
constexpr double kRecordError = 1.0e-6;
// Cuts by cost may be lopsided. From here on halves are equal, so recursion ends soon.
constexpr int kMostLopsided = 64;

SphereBox box_of(const gpu::Sphere& sphere) {
    if (sphere.curvature == 0.0f) {
        const glm::dvec3 end(gpu::kFarthestGround, gpu::kFarthestGround, 0.0);
        return {glm::dvec3(sphere.anchor) - end, glm::dvec3(sphere.anchor) + end};
    }
    const double radius = 1.0 / static_cast<double>(sphere.curvature);
    const glm::dvec3 centre = glm::dvec3(sphere.anchor) - radius * glm::dvec3(sphere.normal);
    const glm::dvec3 reach = radius + kRecordError * (glm::abs(centre) + radius);
    return {centre - reach, centre + reach};
}

class Halving {
  public:
    Halving(std::span<const gpu::SphereRecord> spheres, SphereCut cut)
        : order_(spheres.size()), lopsided_(cut == SphereCut::by_cost ? kMostLopsided : 0) {
        for (const gpu::SphereRecord& sphere : spheres)
            boxes_.push_back(box_of(sphere.shape));
        std::iota(order_.begin(), order_.end(), 0u);
        parts.reserve(2 * spheres.size());
        if (!spheres.empty()) add_part(order_, 0);
    }

    std::vector<SpherePart> parts;

  private:
    using Numbers = std::span<std::uint32_t>;

    std::uint32_t add_part(Numbers numbers, int depth) {
        SpherePart part{.count = static_cast<std::uint32_t>(numbers.size())};
        for (const std::uint32_t i : numbers)
            part.box.add(boxes_[i]);
        if (numbers.size() == 1) part.sphere = numbers.front();
        const auto place = static_cast<std::uint32_t>(parts.size());
        parts.push_back(part);
        if (numbers.size() > 1) {
            const std::size_t first = split(numbers, depth);
            const std::uint32_t one = add_part(numbers.first(first), depth + 1);
            parts[place].halves = {one, add_part(numbers.subspan(first), depth + 1)};
        }
        return place;
    }

    void sort(Numbers numbers, int axis) {
        std::sort(numbers.begin(), numbers.end(), [&](std::uint32_t a, std::uint32_t b) {
            const double at_a = boxes_[a].low[axis] + boxes_[a].high[axis];
            const double at_b = boxes_[b].low[axis] + boxes_[b].high[axis];
            return at_a != at_b ? at_a < at_b : a < b;
        });
    }

    // Orders the spheres of a part along the axis of the cheapest cut. Returns the size of the first half.
    std::size_t split(Numbers numbers, int depth) {
        double least = std::numeric_limits<double>::infinity();
        std::size_t first = numbers.size() / 2;
        int best = 0;
        for (int axis = 0; axis < 3; ++axis) {
            sort(numbers, axis);
            const auto [cost, size] = cheapest_cut(numbers);
            if (cost >= least) continue;
            least = cost;
            best = axis;
            first = size;
        }
        if (best != 2) sort(numbers, best);
        return depth < lopsided_ ? first : numbers.size() / 2;
    }

    struct Cut {
        double cost;
        std::size_t first;
    };

    Cut cheapest_cut(Numbers numbers) {
        std::vector<double> behind(numbers.size());
        SphereBox box;
        for (std::size_t i = numbers.size(); i-- > 1;) {
            box.add(boxes_[numbers[i]]);
            behind[i] = box.half_area();
        }
        Cut cut{std::numeric_limits<double>::infinity(), numbers.size() / 2};
        box = {};
        for (std::size_t i = 1; i < numbers.size(); ++i) {
            box.add(boxes_[numbers[i - 1]]);
            const double cost = box.half_area() * static_cast<double>(i) +
                                behind[i] * static_cast<double>(numbers.size() - i);
            if (cost < cut.cost) cut = {cost, i};
        }
        return cut;
    }

    std::vector<SphereBox> boxes_;
    std::vector<std::uint32_t> order_;
    int lopsided_;
};

}  // namespace

std::vector<SpherePart> halve_spheres(std::span<const gpu::SphereRecord> spheres, SphereCut cut) {
    return std::move(Halving(spheres, cut).parts);
}

}  // namespace voxilux
