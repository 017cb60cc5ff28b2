#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

#include "voxelizer/mesh.h"

namespace voxilux {

// Vertices lie on a lattice of 2^-12 voxel, so that every coverage test is exact in integers. Snapping moves
// a point by at most 0.00022 voxel, and a face at the top of the grid by 0.0004: less than the 0.001 between
// the cells that a correct voxelizer must have and those that it may have.
inline constexpr int kUnitBits = 12;
inline constexpr std::int32_t kUnit = 1 << kUnitBits;

// Largest number of cells on an axis: lattice coordinates then fit 28 bits, and what is computed from them
// 63.
inline constexpr int kMaxCells = 1 << 16;

// Which axis of the mesh points up in the grid, where z is up.
enum class UpAxis : std::uint8_t { x, y, z, minus_x, minus_y, minus_z };

// x, y, z, -x, -y or -z; nothing for another word.
[[nodiscard]] std::optional<UpAxis> parse_up(std::string_view word);
[[nodiscard]] std::string_view name_of(UpAxis up);

struct GridRequest {
    int resolution = 256;                    // cells along the longest side, unless metres_per_voxel is given
    std::optional<double> metres_per_voxel;  // > 0
    std::optional<UpAxis> up;                // else that of the mesh
    int quarter_turns = 0;                   // about the vertical, counter-clockwise seen from above
    bool is_on_floor = false;  // the lowest cells are at z = 0 of the scene, instead of the centre
};

// Cell c of the grid covers [c, c + 1) of (axes * p - low) * scale, p in the mesh's space.
struct MeshGrid {
    glm::dmat3 axes{1.0};  // a rotation that permutes the axes
    glm::dvec3 low{0.0};   // of the rotated mesh
    double scale = 1.0;    // voxels per metre
    glm::ivec3 cells{1};
    glm::ivec3 origin{0};  // the cell at the origin of the scene

    [[nodiscard]] glm::dvec3 to_grid(glm::dvec3 p) const { return (axes * p - low) * scale; }
};

// The axis that points up in a grid of the mesh.
[[nodiscard]] UpAxis up_of(const Mesh& mesh, const GridRequest& request);

// The grid around all triangles whose vertices are finite. Rule: scale = resolution / longest side; the low
// corner of the box is the grid's; cells = ceil(extent * scale), at least 1. A mesh with y up is rotated to
// (x, -z, y). The centre of the grid is the origin of the scene. Throws Error(input_refused) without a
// triangle or with a box that exceeds the range of doubles, Error(usage) for a grid of more than kMaxCells on
// an axis.
[[nodiscard]] MeshGrid grid_of(const Mesh& mesh, const GridRequest& request);

// The same around all finite points of a cloud, with the same errors.
[[nodiscard]] MeshGrid grid_of_points(const Mesh& mesh, const GridRequest& request);

// Every position on the grid's lattice, in [0, cells * kUnit - 1]; positions that are not finite give zero.
[[nodiscard]] std::vector<glm::ivec3> lattice_positions(const Mesh& mesh, const MeshGrid& grid);

// Triangles whose three vertices are finite, in order.
[[nodiscard]] std::vector<std::uint32_t> finite_triangles(const Mesh& mesh);

}  // namespace voxilux
