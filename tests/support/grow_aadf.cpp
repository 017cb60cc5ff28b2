#include "support/grow_aadf.h"

#include <algorithm>

namespace voxilux {
namespace {

constexpr std::array<glm::ivec3, 6> kDirections = {glm::ivec3{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0},
                                                   {0, 0, -1},           {0, 0, 1}};

struct GrowthGrid {
    glm::ivec3 size;
    std::span<const std::uint8_t> filled;
    int max_extent;
    Beyond beyond;

    [[nodiscard]] bool contains(glm::ivec3 c) const {
        return c.x >= 0 && c.y >= 0 && c.z >= 0 && c.x < size.x && c.y < size.y && c.z < size.z;
    }
    [[nodiscard]] std::size_t index(glm::ivec3 c) const {
        const auto x = static_cast<std::size_t>(c.x);
        const auto y = static_cast<std::size_t>(c.y);
        const auto z = static_cast<std::size_t>(c.z);
        return x + static_cast<std::size_t>(size.x) * (y + static_cast<std::size_t>(size.y) * z);
    }
};

// Whether the box of the neighbour covers the slab that `own` would gain in `direction`: it must reach at
// least as far ahead and to the four sides. What lies behind the neighbour does not matter.
bool covers_slab(const Extents& neighbour, const Extents& own, std::size_t direction) {
    const std::size_t behind = direction ^ 1u;
    for (std::size_t side = 0; side < 6; ++side) {
        if (side != behind && neighbour[side] < own[side]) return false;
    }
    return true;
}

bool can_grow(const GrowthGrid& grid, const std::vector<Extents>& extents, glm::ivec3 cell,
              std::size_t direction) {
    const Extents& own = extents[grid.index(cell)];
    if (own[direction] >= grid.max_extent) return false;
    const glm::ivec3 neighbour = cell + kDirections[direction];
    if (!grid.contains(neighbour)) return grid.beyond == Beyond::empty;
    if (grid.filled[grid.index(neighbour)] != 0) return false;
    return covers_slab(extents[grid.index(neighbour)], own, direction);
}

template <class Visit>
void for_each_empty(const GrowthGrid& grid, const Visit& visit) {
    for (int z = 0; z < grid.size.z; ++z) {
        for (int y = 0; y < grid.size.y; ++y) {
            for (int x = 0; x < grid.size.x; ++x) {
                const glm::ivec3 cell{x, y, z};
                if (grid.filled[grid.index(cell)] == 0) visit(cell);
            }
        }
    }
}

}  // namespace

std::vector<Extents> grow_aadf(glm::ivec3 size, std::span<const std::uint8_t> filled, int max_extent,
                               Beyond beyond) {
    const GrowthGrid grid{size, filled, max_extent, beyond};
    std::vector<Extents> extents(filled.size(), Extents{});
    std::vector<Extents> grown = extents;
    // Without an empty outside no box is longer than the grid, so further rounds change nothing.
    const int longest = std::max({size.x, size.y, size.z});
    const int rounds = beyond == Beyond::solid ? std::min(max_extent, longest) : max_extent;
    for (int round = 0; round < rounds; ++round) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            for_each_empty(grid, [&](glm::ivec3 cell) {
                for (const std::size_t direction : {2 * axis, 2 * axis + 1}) {
                    if (can_grow(grid, extents, cell, direction)) ++grown[grid.index(cell)][direction];
                }
            });
            extents = grown;
        }
    }
    return extents;
}

}  // namespace voxilux
