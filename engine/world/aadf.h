#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace voxilux {

// Empty cells around a cell in the directions -x +x -y +y -z +z: the box [c - (-x), c + (+x)] x ... holds no
// voxel.
using Extents = std::array<std::uint8_t, 6>;

// What lies beyond the border of a grid: `solid` keeps boxes inside it, `empty` lets them reach out of it.
enum class Beyond : std::uint8_t { solid, empty };

// Anisotropic distances of every cell of a grid of `size` (x fastest); filled cells get zeros. `filled` holds
// 0 or 1 per cell. All cells grow together, one step per round and axis, x then y then z: a cell grows
// towards a neighbour whose box covers the slab that would be added. Each step reads only the state before
// it, so the result does not depend on the order of the cells. (NAADF, section on construction; O(3 *
// max_extent * cells).)
[[nodiscard]] std::vector<Extents> grow_aadf(glm::ivec3 size, std::span<const std::uint8_t> filled,
                                             int max_extent, Beyond beyond);

// The same for a grid of 4^3 cells given as a bit mask (bit x + 4y + 16z set = filled), extents at most 3,
// nothing beyond the border. All 64 cells grow in parallel in 64-bit words; equal to grow_aadf(.., 3,
// Beyond::solid).
[[nodiscard]] std::array<Extents, 64> grow_aadf_4(std::uint64_t filled);

}  // namespace voxilux
