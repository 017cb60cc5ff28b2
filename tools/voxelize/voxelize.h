#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/step_times.h"
#include "shared_flags.h"
#include "voxelizer/mesh.h"
#include "voxelizer/voxel_palette.h"
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

// A mesh and its voxels.
struct Voxelized {
    Mesh mesh;
    VoxelSet set;
    VoxelPalette palette;
    std::vector<std::string> warnings;
};

void add_voxelize_flags(Flags& flags, VoxelizeCommand& command);

// Reads a mesh and voxelizes it; `times` gets the steps. Throws Error: usage, input_refused.
[[nodiscard]] Voxelized voxelize(const VoxelizeCommand& command, StepTimes& times);

// Reads a mesh and writes it as a .vox file. Returns the exit code. Throws Error: usage, input_refused,
// cannot_write, interrupted.
int run_voxelize(const VoxelizeCommand& command);

}  // namespace voxilux
