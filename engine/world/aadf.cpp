#include "world/aadf.h"

#include <algorithm>

#include "base/assert.h"

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

// Cells of a 4^3 grid whose neighbour in a direction is inside the grid.
constexpr std::array<std::uint64_t, 6> kHasNeighbour4 = {0xEEEEEEEEEEEEEEEEull, 0x7777777777777777ull,
                                                         0xFFF0FFF0FFF0FFF0ull, 0x0FFF0FFF0FFF0FFFull,
                                                         0xFFFFFFFFFFFF0000ull, 0x0000FFFFFFFFFFFFull};
constexpr std::array<int, 6> kShift4 = {1, 1, 4, 4, 16, 16};

// Bit of each cell's neighbour in `direction`, moved to the cell; 0 where there is none.
std::uint64_t neighbours_4(std::uint64_t mask, std::size_t direction) {
    const std::uint64_t moved = direction % 2 == 0 ? mask << kShift4[direction] : mask >> kShift4[direction];
    return moved & kHasNeighbour4[direction];
}

// Extents of 64 cells in unary: bit c of reach[direction][k] says that cell c reaches more than k cells.
using Reach = std::array<std::array<std::uint64_t, 3>, 6>;

std::uint64_t growing_4(const Reach& reach, std::uint64_t empty, std::size_t direction) {
    std::uint64_t grows = empty & neighbours_4(empty, direction);
    for (std::size_t side = 0; side < 6; ++side) {
        if (side == (direction ^ 1u)) continue;
        for (const std::uint64_t reaching : reach[side])
            grows &= ~reaching | neighbours_4(reaching, direction);
    }
    return grows;
}

void extend_4(std::array<std::uint64_t, 3>& reach, std::uint64_t grows) {
    const std::uint64_t third = reach[1] & grows;
    const std::uint64_t second = reach[0] & grows;
    reach[2] |= third;
    reach[1] |= second;
    reach[0] |= grows;
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

std::array<Extents, 64> grow_aadf_4(std::uint64_t filled) {
    const std::uint64_t empty = ~filled;
    Reach reach{};
    for (int round = 0; round < 3; ++round) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::uint64_t low = growing_4(reach, empty, 2 * axis);
            const std::uint64_t high = growing_4(reach, empty, 2 * axis + 1);
            extend_4(reach[2 * axis], low);
            extend_4(reach[2 * axis + 1], high);
        }
    }
    std::array<Extents, 64> extents{};
    for (std::size_t cell = 0; cell < 64; ++cell) {
        for (std::size_t direction = 0; direction < 6; ++direction) {
            for (const std::uint64_t reaching : reach[direction])
                extents[cell][direction] =
                    static_cast<std::uint8_t>(extents[cell][direction] + ((reaching >> cell) & 1u));
        }
    }
    return extents;
}

}  // namespace voxilux
