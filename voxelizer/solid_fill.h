#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "voxelizer/bin_triangles.h"
#include "voxelizer/voxelize_block.h"

namespace voxilux {

// Filled cells of a row in a block that the surface does not touch.
struct InteriorRow {
    std::uint16_t row = 0;    // y + 64 z
    std::uint64_t cells = 0;  // bit x

    bool operator==(const InteriorRow&) const = default;
};

// What is wrong with the inside of a mesh.
struct SolidReport {
    std::uint64_t open_edges = 0;  // shared by an odd number of triangles
    std::uint64_t open_rows =
        0;  // lines that enter the mesh and do not leave it, or the other way: not filled
    std::uint64_t disputed = 0;  // cells where parity and winding number disagree: the mesh overlaps itself
};

// A stretch of a row that is inside.
struct InsideRun {
    std::int32_t y = 0, z = 0;
    std::int32_t first = 0, last = 0;
};

// Cells whose middle is inside by parity: a line along x through the middles meets the surface an odd number
// of times before it. Rows by z, then y. Exact on the lattice; a shared edge counts once.
[[nodiscard]] std::vector<InsideRun> inside_runs(const Mesh& mesh, std::span<const std::uint32_t> triangles,
                                                 std::span<const glm::ivec3> lattice, glm::ivec3 cells,
                                                 SolidReport& report);

}  // namespace voxilux
