#pragma once

#include <string>

#include "shared_flags.h"

namespace voxilux {

struct ConvertCommand {
    std::string input;
    std::string output;
    GridRequest grid;  // of a mesh
    bool quiet = false;
};

void add_convert_flags(Flags& flags, ConvertCommand& command);

// Reads voxels or a mesh and writes a .vox file, or voxels as a .glb mesh. Returns the exit code. Throws
// Error: usage, input_refused, cannot_write.
int run_convert(const ConvertCommand& command);

}  // namespace voxilux
