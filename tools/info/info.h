#pragma once

#include <string>

#include "flags.h"
#include "voxelizer/mesh_grid.h"

namespace voxilux {

struct InfoOptions {
    std::string file;
    GridRequest grid;  // of a mesh
    std::string json;  // where the facts go as JSON; "-": standard output, instead of text; empty: nowhere
};

void add_info_flags(Flags& flags, InfoOptions& options);

// Prints what is in a .vox, .toml, .exr or .png file, voxels of another format or a mesh on standard output.
// Returns the exit code; throws Error(input_refused) when the file is refused or of a kind that we do not
// know.
int run_info(const InfoOptions& options);

}  // namespace voxilux
