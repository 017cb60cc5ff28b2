#pragma once

#include <cstdint>

#include <glm/glm.hpp>

#include "world/cell_bounds.h"

namespace voxilux {

// The distances of an empty cell (aadf.h), made so short in one direction that its box keeps clear of
// `filled`: in the direction that leaves the most of the box. None where the cell itself lies within.
[[nodiscard]] std::uint32_t cut_distances(std::uint32_t distances, glm::ivec3 cell, const CellBounds& filled);

}  // namespace voxilux
