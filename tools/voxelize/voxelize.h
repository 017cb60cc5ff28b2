#pragma once

#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace voxilux {

struct VoxelizeCommand {
    std::string mesh;
    std::string output;  // empty: named after the mesh, in the current folder
    int resolution = 256;
    std::optional<double> scale_m;
    std::string up = "y";
    int turn_deg = 0;
    bool thin = false;
    bool solid = false;
    bool parity = false;
    bool on_floor = false;
    bool dither = false;
    bool ignore_mask = false;
    bool strict = false;
    bool quiet = false;
    std::optional<unsigned> scene;
    unsigned threads = 0;
    std::string progress = "auto";
    std::string json;
};

// Declares the subcommand and its flags; parsing fills `command`, which must outlive the app.
CLI::App* add_voxelize(CLI::App& app, VoxelizeCommand& command);

// Reads a mesh and writes it as a .vox file. Returns the exit code. Throws Error: usage, input_refused,
// cannot_write, interrupted.
int run_voxelize(const VoxelizeCommand& command);

}  // namespace voxilux
