#pragma once

#include <functional>
#include <string>
#include <vector>

#include "voxelizer/mesh_grid.h"
#include "voxelizer/solid_fill.h"
#include "voxelizer/voxelize_block.h"

namespace voxilux {

struct VoxelizeRequest {
    GridRequest grid;
    Coverage coverage = Coverage::conservative;
    bool is_solid = false;
    InsideRule inside = InsideRule::winding;  // with is_solid
    unsigned threads = 0;  // 0: as many as the machine has; the result does not depend on it
    std::function<void(double done)> progress;  // fraction done, from any thread, one at a time; may throw
};

// The voxels of a block of 64^3 cells.
struct VoxelBlock {
    glm::ivec3 low{0};
    std::uint32_t model = 0;  // see Block
    std::vector<ColouredVoxel> surface;
    std::vector<InteriorRow> interior;
};

struct VoxelSet {
    MeshGrid grid;
    std::vector<VoxelBlock> blocks;  // by model, then z, y, x; none is empty
    std::uint64_t surface = 0;       // voxels
    std::uint64_t interior = 0;
    std::uint64_t masked = 0;   // cells that alpha masks leave empty
    std::uint64_t dropped = 0;  // triangles with a vertex that is not finite
    SolidReport solid;          // with is_solid
};

// Cells, colours and looks of a mesh. Memory follows the surface: 8 bytes per voxel, and scratch per thread.
// Throws what grid_of throws, and Error(input_refused) when no voxel is left.
[[nodiscard]] VoxelSet voxelize_mesh(const Mesh& mesh, const VoxelizeRequest& request);

}  // namespace voxilux
