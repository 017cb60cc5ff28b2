#pragma once

#include <cstdint>
#include <span>

#include <glm/glm.hpp>

namespace voxilux {

// Rolling ground inside a box of columns.
struct TerrainShape {
    glm::ivec3 from{0};
    glm::ivec3 to{1};
    std::uint32_t seed = 0;
    int feature = 32;     // voxels from one hill to the next, >= 1
    bool island = false;  // falls to nothing towards the sides of the box
};

// How many cells of the columns (x, y), (x + 1, y), ... are filled, from the floor of the box: in [0, to.z -
// from.z]. Integer arithmetic only, so it is the same on every machine. Source: value noise on a lattice of
// hashed heights, Perlin 1985's smoothing of the cell (3 t^2 - 2 t^3), four octaves that halve in size and in
// weight, stretched to the range.
void terrain_heights(const TerrainShape& terrain, int x, int y, std::span<int> heights);

}  // namespace voxilux
