#include "voxelizer/quantize_colours.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/assert.h"

namespace voxilux {
namespace {

// Lloyd's iterations; more would change the mean error by less than a hundredth.
constexpr int kLloydRounds = 5;
// Steps of the power iteration that finds a principal axis: any axis close to it will do.
constexpr int kAxisRounds = 6;

// Colours order[first..end) of one group.
struct ColourBox {
    std::size_t first = 0;
    std::size_t end = 0;
    std::uint32_t group = 0;
    glm::dvec3 mean{0.0};
    glm::dvec3 axis{1.0, 0.0, 0.0};
    double error = 0.0;  // squared, weighted
};

class Splitter {
  public:
    explicit Splitter(std::span<const WeightedColour> colours) : colours_(colours), order_(colours.size()) {
        std::iota(order_.begin(), order_.end(), std::size_t{0});
        std::ranges::stable_sort(order_, {}, [&](std::size_t i) { return colours_[i].group; });
        for (std::size_t i = 0; i < order_.size();) {
            const std::size_t first = i;
            const std::uint32_t group = colours_[order_[first]].group;
            while (i < order_.size() && colours_[order_[i]].group == group)
                ++i;
            parts_.push_back(measured({.first = first, .end = i, .group = group}));
        }
    }

    void split_until(std::size_t most) {
        VX_ASSERT(parts_.size() <= most);
        while (parts_.size() < most) {
            const auto worst = std::ranges::max_element(parts_, {}, &ColourBox::error);
            if (worst == parts_.end() || !(worst->error > 0.0)) return;
            const ColourBox whole = *worst;
            const auto begin = order_.begin();
            const auto middle = std::stable_partition(
                begin + static_cast<std::ptrdiff_t>(whole.first),
                begin + static_cast<std::ptrdiff_t>(whole.end), [&](std::size_t i) {
                    return glm::dot(glm::dvec3(colours_[i].oklab) - whole.mean, whole.axis) < 0.0;
                });
            const auto cut = static_cast<std::size_t>(middle - begin);
            if (cut == whole.first || cut == whole.end) {
                worst->error = 0.0;  // differences too small to tell apart
                continue;
            }
            *worst = measured({.first = whole.first, .end = cut, .group = whole.group});
            parts_.push_back(measured({.first = cut, .end = whole.end, .group = whole.group}));
        }
    }

    [[nodiscard]] QuantizedColours result() {
        std::ranges::stable_sort(parts_, {}, &ColourBox::group);
        QuantizedColours result{.entry_of = std::vector<std::uint16_t>(colours_.size())};
        for (const ColourBox& part : parts_) {
            for (std::size_t i = part.first; i < part.end; ++i)
                result.entry_of[order_[i]] = static_cast<std::uint16_t>(result.entries.size());
            result.entries.push_back({glm::vec3(part.mean), part.group});
        }
        return result;
    }

  private:
    [[nodiscard]] ColourBox measured(ColourBox part) const {
        double weight = 0.0;
        glm::dvec3 sum(0.0);
        for (std::size_t i = part.first; i < part.end; ++i) {
            const WeightedColour& c = colours_[order_[i]];
            sum += glm::dvec3(c.oklab) * double{c.weight};
            weight += double{c.weight};
        }
        part.mean = weight > 0.0 ? sum / weight : sum;
        glm::dmat3 covariance(0.0);
        for (std::size_t i = part.first; i < part.end; ++i) {
            const WeightedColour& c = colours_[order_[i]];
            const glm::dvec3 d = glm::dvec3(c.oklab) - part.mean;
            covariance += glm::outerProduct(d, d) * double{c.weight};
        }
        part.error = part.end - part.first > 1 ? covariance[0][0] + covariance[1][1] + covariance[2][2] : 0.0;
        part.axis = principal_axis(covariance);
        return part;
    }

    static glm::dvec3 principal_axis(const glm::dmat3& covariance) {
        glm::dvec3 axis = covariance[0];
        for (int k = 1; k < 3; ++k) {
            if (glm::length(covariance[k]) > glm::length(axis)) axis = covariance[k];
        }
        for (int round = 0; round < kAxisRounds && glm::length(axis) > 0.0; ++round)
            axis = covariance * (axis / glm::length(axis));
        return glm::length(axis) > 0.0 ? axis / glm::length(axis) : glm::dvec3(1.0, 0.0, 0.0);
    }

    std::span<const WeightedColour> colours_;
    std::vector<std::size_t> order_;
    std::vector<ColourBox> parts_;
};

// Entries of each group: first and end.
std::vector<std::array<std::size_t, 2>> group_ranges(const std::vector<QuantizedColours::Entry>& entries) {
    std::vector<std::array<std::size_t, 2>> ranges;
    for (std::size_t i = 0; i < entries.size(); ++i) {
        ranges.resize(std::max<std::size_t>(ranges.size(), entries[i].group + std::size_t{1}), {i, i});
        ranges[entries[i].group][1] = i + 1;
    }
    return ranges;
}

std::uint16_t nearest(const std::vector<QuantizedColours::Entry>& entries, std::array<std::size_t, 2> range,
                      glm::vec3 colour) {
    std::size_t best = range[0];
    float least = std::numeric_limits<float>::infinity();
    for (std::size_t i = range[0]; i < range[1]; ++i) {
        const glm::vec3 d = entries[i].oklab - colour;
        const float square = glm::dot(d, d);
        if (square < least) {
            least = square;
            best = i;
        }
    }
    return static_cast<std::uint16_t>(best);
}

void move_to_means(std::span<const WeightedColour> colours, QuantizedColours& result) {
    std::vector<glm::dvec4> sums(result.entries.size(), glm::dvec4(0.0));
    for (std::size_t i = 0; i < colours.size(); ++i)
        sums[result.entry_of[i]] += glm::dvec4(colours[i].oklab, 1.0) * double{colours[i].weight};
    for (std::size_t e = 0; e < sums.size(); ++e) {
        if (sums[e].w > 0.0) result.entries[e].oklab = glm::vec3(glm::dvec3(sums[e]) / sums[e].w);
    }
}

}  // namespace

QuantizedColours quantize_colours(std::span<const WeightedColour> colours, std::size_t most) {
    Splitter splitter(colours);
    splitter.split_until(most);
    QuantizedColours result = splitter.result();
    const auto ranges = group_ranges(result.entries);
    for (int round = 0; round < kLloydRounds; ++round) {
        for (std::size_t i = 0; i < colours.size(); ++i)
            result.entry_of[i] = nearest(result.entries, ranges[colours[i].group], colours[i].oklab);
        move_to_means(colours, result);
    }
    return result;
}

}  // namespace voxilux
