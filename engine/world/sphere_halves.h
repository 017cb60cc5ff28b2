#pragma once

// Spheres in two parts, and these in two again: what the hierarchy over spheres is made from.

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "shared/gpu_types.h"

namespace voxilux {

struct SphereBox {
    glm::dvec3 low{std::numeric_limits<double>::infinity()};
    glm::dvec3 high{-std::numeric_limits<double>::infinity()};

    void add(const SphereBox& other) {
        low = glm::min(low, other.low);
        high = glm::max(high, other.high);
    }
    [[nodiscard]] double half_area() const {
        const glm::dvec3 e = high - low;
        return e.x * e.y + e.y * e.z + e.z * e.x;
    }
    [[nodiscard]] double extent() const { return std::max({high.x - low.x, high.y - low.y, high.z - low.z}); }
};

struct SpherePart {
    SphereBox box;
    std::uint32_t count = 0;                // spheres
    std::uint32_t sphere = gpu::kNoSphere;  // of a part of one
    std::array<std::uint32_t, 2> halves{};  // of the others: places in the list of parts
};

// How a part is cut: so that the halves cost a ray the least (surface area heuristic), or into equal numbers,
// which bounds the depth.
enum class SphereCut { by_cost, by_number };

// All parts, the whole first; none for no spheres.
[[nodiscard]] std::vector<SpherePart> halve_spheres(std::span<const gpu::SphereRecord> spheres,
                                                    SphereCut cut);

}  // namespace voxilux
