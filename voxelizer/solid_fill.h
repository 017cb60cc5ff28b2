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

// Which cells are inside. Where a mesh overlaps itself it is solid by winding number, and hollow by parity.
enum class InsideRule : std::uint8_t { winding, parity };

// Defects of the inside of a mesh.
struct SolidReport {
    std::uint64_t open_edges = 0;    // shared by an odd number of triangles
    std::uint64_t turned_edges = 0;  // shared by an even number whose orientations disagree
    std::uint64_t open_rows = 0;     // by parity: lines that enter the mesh and do not leave it: not filled
    std::uint64_t disputed = 0;  // cells where parity and winding number disagree: the mesh overlaps itself
};

struct SolidInput {
    const Mesh& mesh;
    std::span<const std::uint32_t> triangles;
    std::span<const glm::ivec3> lattice;
    glm::ivec3 cells{1};
    unsigned threads = 1;
};

// A run of cells of a row that is inside.
struct InsideRun {
    std::int32_t y = 0, z = 0;
    std::int32_t first = 0, last = 0;
};

// Cells whose centre is inside; rows ordered by z, then y. In a closed mesh, the surfaces that a line along x
// through cell centres meets before a cell are counted, exactly on the lattice; a shared edge counts once. By
// winding number a cell is inside unless as many lead in as out. In an open mesh the generalised winding
// number decides, above 1/2; a closed mesh that is not oriented is filled by parity.
[[nodiscard]] std::vector<InsideRun> inside_runs(const SolidInput& input, InsideRule rule,
                                                 SolidReport& report);

}  // namespace voxilux
