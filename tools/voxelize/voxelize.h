#pragma once

#include <optional>
#include <string>

#include "shared_flags.h"
#include "voxelizer/voxelize_mesh.h"

namespace voxilux {

struct VoxelizeCommand {
    std::string mesh;
    std::string output;  // empty: named after the mesh, in the current folder
    VoxelizeRequest request;
    bool thin = false;
    bool parity = false;
    bool dither = false;
    bool ignore_mask = false;
    bool strict = false;
    std::optional<unsigned> scene;
    ProgressMode progress = ProgressMode::automatic;
    ReportOptions report;
};

void add_voxelize_flags(Flags& flags, VoxelizeCommand& command);

// Reads a mesh and writes it as a .vox file. Returns the exit code. Throws Error: usage, input_refused,
// cannot_write, interrupted.
int run_voxelize(const VoxelizeCommand& command);

}  // namespace voxilux
