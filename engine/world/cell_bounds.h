#pragma once

#include <cstdint>
#include <limits>

#include <glm/glm.hpp>

namespace voxilux {

// Cells low <= c < high.
struct CellBounds {
    glm::ivec3 low{std::numeric_limits<int>::max()};
    glm::ivec3 high{std::numeric_limits<int>::min()};

    [[nodiscard]] bool empty() const { return low.x >= high.x || low.y >= high.y || low.z >= high.z; }
    void include(const CellBounds& other) {
        if (other.empty()) return;
        low = glm::min(low, other.low);
        high = glm::max(high, other.high);
    }
    void include(glm::ivec3 cell) { include(CellBounds{cell, cell + 1}); }
    [[nodiscard]] CellBounds grown(glm::ivec3 by) const {
        return empty() ? *this : CellBounds{low - by, high + by};
    }
    // The part inside a grid of so many cells.
    [[nodiscard]] CellBounds inside(glm::ivec3 size) const {
        return {glm::max(low, glm::ivec3(0)), glm::min(high, size)};
    }
    [[nodiscard]] std::int64_t count() const {
        if (empty()) return 0;
        const glm::i64vec3 extent(high - low);
        return extent.x * extent.y * extent.z;
    }
    [[nodiscard]] CellBounds children() const { return empty() ? *this : CellBounds{low * 4, high * 4}; }
    // All parents of 4^3 cells.
    [[nodiscard]] CellBounds parents() const {
        return empty() ? *this : CellBounds{low >> 2, ((high - 1) >> 2) + 1};
    }
    [[nodiscard]] bool contains(glm::ivec3 c) const {
        return c.x >= low.x && c.y >= low.y && c.z >= low.z && c.x < high.x && c.y < high.y && c.z < high.z;
    }
};

}  // namespace voxilux
