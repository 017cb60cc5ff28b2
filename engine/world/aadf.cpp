#include "world/aadf.h"

namespace voxilux {
namespace {

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
