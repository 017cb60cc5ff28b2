#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "world/aadf.h"

namespace voxilux {

// What lies beyond the border of a grid: `solid` keeps boxes inside it, `empty` lets them reach out of it.
enum class Beyond : std::uint8_t { solid, empty };

// Anisotropic distances of every cell of a grid of `size` (x fastest); filled cells get zeros. `filled` holds
// 0 or 1 per cell. All cells grow together, one step per round and axis, x then y then z: a cell grows
// towards a neighbour whose box covers the slab that would be added. Each step reads only the state before
// it, so the result does not depend on the order of the cells. (NAADF, section on construction; O(3 *
// max_extent * cells).)
[[nodiscard]] std::vector<Extents> grow_aadf(glm::ivec3 size, std::span<const std::uint8_t> filled,
                                             int max_extent, Beyond beyond);

}  // namespace voxilux
