#pragma once

#include <array>
#include <cstdint>

namespace voxilux {

// Which of the 64 cells of a brick and of the 26 around it are filled: bit x + 4y + 16z of word
// (x + 1) + 3(y + 1) + 9(z + 1) for the brick at (x, y, z), each -1 to 1; the brick itself is word 13.
using BrickSurroundings = std::array<std::uint64_t, 27>;

// Distances of the cells of the middle brick, at most 3, in the six fields of 2 bits of world_cell.h; 0 for
// filled cells. A box starts as its cell; three times over it grows by one cell towards -x +x -y +y -z +z in
// turn, wherever the slab it would gain is empty, across the border of the brick too. All 64 cells grow at
// once in 64-bit words.
[[nodiscard]] std::array<std::uint16_t, 64> near_boxes(const BrickSurroundings& filled);

}  // namespace voxilux
