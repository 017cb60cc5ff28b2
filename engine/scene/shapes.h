#pragma once

#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include <glm/glm.hpp>

#include "scene/scene_bounds.h"
#include "scene/terrain.h"
#include "scene/voxel_grid.h"

namespace voxilux {

// What a shape fills its cells with; nothing means air, which carves.
using Filling = std::optional<std::uint16_t>;

// The cells from <= c < to. Hollow: only those with a face neighbour outside.
struct BoxShape {
    glm::ivec3 from{0};
    glm::ivec3 to{1};
    bool hollow = false;
    Filling filling;
};

// The cells whose middle lies at most `radius` from `centre`. Hollow as for the box.
struct BallShape {
    glm::dvec3 centre{0.0};
    double radius = 1.0;
    bool hollow = false;
    Filling filling;
};

// Ground; cell z of a column of the box gets layer floor(z * layers / height), counted from the floor.
struct GroundShape {
    TerrainShape terrain;
    std::vector<Filling> layers;  // bottom to top, at least one
};

// A trunk of `height` cells on `base` and a ragged ball of leaves around its top.
struct TreeShape {
    glm::ivec3 base{0};
    int height = 8;
    double crown = 4.0;  // radius
    std::uint32_t seed = 0;
    Filling trunk;
    Filling leaves;
};

using Shape = std::variant<BoxShape, BallShape, GroundShape, TreeShape>;

// A box that holds every cell the shape may touch. Needs coordinates and radii below 2^24.
[[nodiscard]] Box shape_bounds(const Shape& shape);

// An upper bound of the rows and cells that drawing visits: what time and memory grow with.
[[nodiscard]] double shape_work(const Shape& shape);

// Fills or carves the cells of the shape. Its bounds must lie within kMaxGridCoordinate.
void draw_shape(VoxelGrid& grid, const Shape& shape);

}  // namespace voxilux
