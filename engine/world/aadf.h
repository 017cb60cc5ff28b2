#pragma once

#include <array>
#include <cstdint>

namespace voxilux {

// Empty cells around a cell in the directions -x +x -y +y -z +z: the box [c - (-x), c + (+x)] x ... holds no
// voxel.
using Extents = std::array<std::uint8_t, 6>;

// Anisotropic distances of a grid of 4^3 cells given as a bit mask (bit x + 4y + 16z set = filled), at most
// 3, nothing beyond the border; filled cells get zeros. All cells grow together in 64-bit words, one step per
// round and axis, x then y then z: a cell grows towards a neighbour whose box covers the slab that would be
// added. (NAADF, section on construction.)
[[nodiscard]] std::array<Extents, 64> grow_aadf_4(std::uint64_t filled);

}  // namespace voxilux
