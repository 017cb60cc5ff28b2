#include "world/near_boxes.h"

#include <cstddef>

#include "shared/world_cell.h"

namespace voxilux {
namespace {

constexpr int kReach = 3;              // cells
constexpr int kSpan = 2 * kReach + 1;  // offsets -3 to 3
constexpr std::array<int, 3> kStride = {1, 4, 16};

// Bit of each cell whose coordinate on the axis is below `end`.
constexpr std::uint64_t cells_below(int axis, int end) {
    std::uint64_t mask = 0;
    for (int i = 0; i < 64; ++i) {
        const int coordinate = i / kStride[static_cast<std::size_t>(axis)] % 4;
        if (coordinate < end) mask |= std::uint64_t{1} << i;
    }
    return mask;
}

constexpr std::array<std::array<std::uint64_t, 5>, 3> kBelow = [] {
    std::array<std::array<std::uint64_t, 5>, 3> below{};
    for (int axis = 0; axis < 3; ++axis)
        for (int end = 0; end < 5; ++end)
            below[static_cast<std::size_t>(axis)][static_cast<std::size_t>(end)] = cells_below(axis, end);
    return below;
}();

// Three bricks in a row along an axis.
struct Row {
    std::uint64_t low;
    std::uint64_t middle;
    std::uint64_t high;
};

// For each cell of the middle brick the bit of the cell `offset` further along the axis.
std::uint64_t moved(const Row& row, std::size_t axis, int offset) {
    const int stride = kStride[axis];
    if (offset == 0) return row.middle;
    if (offset > 0) {
        const std::uint64_t inside = kBelow[axis][static_cast<std::size_t>(4 - offset)];
        return ((row.middle >> (offset * stride)) & inside) |
               ((row.high << ((4 - offset) * stride)) & ~inside);
    }
    const std::uint64_t outside = kBelow[axis][static_cast<std::size_t>(-offset)];
    return ((row.middle << (-offset * stride)) & ~outside) | ((row.low >> ((4 + offset) * stride)) & outside);
}

constexpr std::size_t at(int offset) {
    return static_cast<std::size_t>(offset + kReach);
}

// filled[z][y][x]: for each cell whether the cell at that offset is filled.
using Offsets = std::array<std::array<std::array<std::uint64_t, kSpan>, kSpan>, kSpan>;

Offsets at_all_offsets(const BrickSurroundings& filled) {
    Offsets offsets;
    for (int x = -kReach; x <= kReach; ++x) {
        std::array<std::array<std::uint64_t, 3>, 3> along_x;  // [z][y] of the bricks
        for (std::size_t row = 0; row < 9; ++row)
            along_x[row / 3][row % 3] =
                moved({filled[3 * row], filled[3 * row + 1], filled[3 * row + 2]}, 0, x);
        for (int y = -kReach; y <= kReach; ++y) {
            std::array<std::uint64_t, 3> along_xy;
            for (std::size_t z = 0; z < 3; ++z)
                along_xy[z] = moved({along_x[z][0], along_x[z][1], along_x[z][2]}, 1, y);
            for (int z = -kReach; z <= kReach; ++z)
                offsets[at(z)][at(y)][at(x)] = moved({along_xy[0], along_xy[1], along_xy[2]}, 2, z);
        }
    }
    return offsets;
}

// Bit c of reach[direction][k] says that the box of cell c reaches more than k cells in that direction.
using Reach = std::array<std::array<std::uint64_t, kReach>, 6>;

// Cells whose box holds the offset along the axis.
std::uint64_t holds(const Reach& reach, std::size_t axis, int offset) {
    if (offset == 0) return ~std::uint64_t{0};
    const std::size_t direction = 2 * axis + (offset > 0 ? 1 : 0);
    return reach[direction][static_cast<std::size_t>(offset > 0 ? offset : -offset) - 1];
}

// Cells for which the slab at `offset` along `axis`, as wide as their box, holds a filled cell. Boxes reach
// at most `round` cells.
std::uint64_t blocked(const Offsets& filled, const Reach& reach, std::size_t axis, int offset, int round) {
    const std::size_t side = axis == 0 ? 1 : 0;
    const std::size_t other = axis == 2 ? 1 : 2;
    std::uint64_t hit = 0;
    std::array<int, 3> to{};
    to[axis] = offset;
    for (to[other] = -round; to[other] <= round; ++to[other]) {
        std::uint64_t in_line = 0;
        for (to[side] = -round; to[side] <= round; ++to[side])
            in_line |= filled[at(to[2])][at(to[1])][at(to[0])] & holds(reach, side, to[side]);
        hit |= in_line & holds(reach, other, to[other]);
    }
    return hit;
}

std::array<std::uint16_t, 64> pack(const Reach& reach) {
    std::array<std::uint64_t, 12> bits;  // of the packed distances, low bit of a direction first
    for (std::size_t direction = 0; direction < 6; ++direction) {
        const auto& [first, second, third] = reach[direction];
        bits[2 * direction] = (first & ~second) | third;
        bits[2 * direction + 1] = second;
    }
    std::array<std::uint16_t, 64> boxes{};
    for (std::size_t bit = 0; bit < bits.size(); ++bit)
        for (std::size_t i = 0; i < 64; ++i)
            boxes[i] = static_cast<std::uint16_t>(boxes[i] | (((bits[bit] >> i) & 1u) << bit));
    return boxes;
}

}  // namespace

std::array<std::uint16_t, 64> near_boxes(const BrickSurroundings& filled) {
    const Offsets offsets = at_all_offsets(filled);
    const std::uint64_t empty = ~filled[13];
    Reach reach{};
    for (int round = 1; round <= kReach; ++round) {
        for (std::size_t direction = 0; direction < 6; ++direction) {
            const int offset = direction % 2 == 0 ? -round : round;
            const std::uint64_t grown =
                round == 1 ? empty : reach[direction][static_cast<std::size_t>(round - 2)];
            reach[direction][static_cast<std::size_t>(round - 1)] =
                grown & ~blocked(offsets, reach, direction / 2, offset, round);
        }
    }
    return pack(reach);
}

}  // namespace voxilux
