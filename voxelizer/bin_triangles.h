#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "voxelizer/mesh_grid.h"

namespace voxilux {

// The grid is divided twice: into models of 256^3 cells, as stored in the file, and those into blocks of
// 64^3, which are processed one by one.
inline constexpr int kModelCells = 256;
inline constexpr int kBlockCells = 64;

// A block and the triangles that touch it, in the order of the mesh.
struct Block {
    glm::ivec3 low{0};        // its lowest cell in the grid
    std::uint32_t model = 0;  // index in the grid of models, x fastest
    std::size_t first = 0;    // in Bins::triangles
    std::size_t count = 0;
};

struct Bins {
    std::vector<Block> blocks;  // by model, then z, y, x; only those that a triangle touches
    std::vector<std::uint32_t> triangles;
};

// Which triangles (indices into mesh.triangles) touch which blocks. The test is exact, so a large slanted
// triangle costs the blocks along its surface, not those of its bounding box.
[[nodiscard]] Bins bin_triangles(const Mesh& mesh, std::span<const std::uint32_t> triangles,
                                 std::span<const glm::ivec3> lattice, glm::ivec3 cells);

// The models that a grid of this many cells needs on each axis.
[[nodiscard]] glm::ivec3 model_counts(glm::ivec3 cells);

// The index of the model that holds a cell: x fastest, then y, z.
[[nodiscard]] std::uint32_t model_of(glm::ivec3 cell, glm::ivec3 cells);

}  // namespace voxilux
