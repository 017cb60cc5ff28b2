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

// The same along z, where shifts alone drop what leaves the brick.
std::uint64_t moved_by_layers(const std::array<std::uint64_t, 3>& bricks, int offset) {
    if (offset == 0) return bricks[1];
    const int stride = kStride[2];
    if (offset > 0) return bricks[1] >> (offset * stride) | bricks[2] << ((4 - offset) * stride);
    return bricks[1] << (-offset * stride) | bricks[0] >> ((4 + offset) * stride);
}

constexpr std::size_t at(int offset) {
    return static_cast<std::size_t>(offset + kReach);
}

constexpr std::array<int, 3> kOffsetStride = {1, kSpan, kSpan* kSpan};

// For each cell whether the cell at an offset is filled; x fastest.
using Offsets = std::array<std::uint64_t, std::size_t{kSpan} * kSpan * kSpan>;

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
                offsets[at(x) + kSpan * (at(y) + kSpan * at(z))] = moved_by_layers(along_xy, z);
        }
    }
    return offsets;
}

// For each axis and each offset along it the cells whose box holds it.
using BoxCells = std::array<std::array<std::uint64_t, kSpan>, 3>;

// Those of the cells `grown` for which the slab at `offset` along `axis`, as wide as their box, holds a
// filled cell. Boxes reach at most `round` cells.
std::uint64_t blocked(const Offsets& filled, const BoxCells& reach, std::uint64_t grown, std::size_t axis,
                      int offset, int round) {
    const std::size_t side = axis == 0 ? 1 : 0;
    const std::size_t other = axis == 2 ? 1 : 2;
    const std::uint64_t* const slab = &filled[filled.size() / 2] + kOffsetStride[axis] * offset;
    std::uint64_t hit = 0;
    for (int i = -round; i <= round; ++i) {
        const std::uint64_t* const line = slab + kOffsetStride[other] * i;
        std::uint64_t in_line = 0;
        for (int k = -round; k <= round; ++k)
            in_line |= line[kOffsetStride[side] * k] & reach[side][at(k)];
        hit |= in_line & reach[other][at(i)];
    }
    return grown & hit;
}

// The eight bits of each byte as eight numbers.
constexpr std::array<std::array<std::uint16_t, 8>, 256> kSpread = [] {
    std::array<std::array<std::uint16_t, 8>, 256> spread{};
    for (std::size_t byte = 0; byte < 256; ++byte)
        for (std::size_t i = 0; i < 8; ++i)
            spread[byte][i] = static_cast<std::uint16_t>(byte >> i & 1);
    return spread;
}();

std::array<std::uint16_t, 64> pack(const BoxCells& reach) {
    std::array<std::uint64_t, 12> bits;  // of the packed distances, low bit of a direction first
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (const std::size_t up : {0u, 1u}) {
            const auto cells = [&](int distance) { return reach[axis][at(up != 0 ? distance : -distance)]; };
            bits[2 * (2 * axis + up)] = (cells(1) & ~cells(2)) | cells(3);
            bits[2 * (2 * axis + up) + 1] = cells(2);
        }
    }
    std::array<std::uint16_t, 64> boxes{};
    for (std::size_t byte = 0; byte < 8; ++byte) {
        for (std::size_t bit = 0; bit < bits.size(); ++bit) {
            const auto& spread = kSpread[bits[bit] >> (8 * byte) & 0xFF];
            for (std::size_t i = 0; i < 8; ++i)
                boxes[8 * byte + i] = static_cast<std::uint16_t>(boxes[8 * byte + i] | spread[i] << bit);
        }
    }
    return boxes;
}

}  // namespace

std::array<std::uint16_t, 64> near_boxes(const BrickSurroundings& filled) {
    const Offsets offsets = at_all_offsets(filled);
    const std::uint64_t empty = ~filled[13];
    BoxCells reach{};
    for (auto& along : reach)
        along[at(0)] = ~std::uint64_t{0};
    for (int round = 1; round <= kReach; ++round) {
        for (std::size_t direction = 0; direction < 6; ++direction) {
            const std::size_t axis = direction / 2;
            const int sign = direction % 2 == 0 ? -1 : 1;
            const std::uint64_t grown = empty & reach[axis][at(sign * (round - 1))];
            reach[axis][at(sign * round)] =
                grown & ~blocked(offsets, reach, grown, axis, sign * round, round);
        }
    }
    return pack(reach);
}

}  // namespace voxilux
