#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace voxilux {

struct MergeCommand {
    std::vector<std::string> parts;
    std::vector<std::string> outputs;
    std::string json;
    std::string tone = "filmic";
    float exposure_ev = 0.0f;
    bool partial = false;
    bool reproducible = false;
    bool quiet = false;
};

CLI::App* add_merge(CLI::App& app, MergeCommand& command);

// Adds the parts of a render up and writes its picture. Returns done. Throws Error(input_refused) for parts
// that do not belong together, and for missing ones unless --partial was given.
[[nodiscard]] int run_merge(const MergeCommand& command);

}  // namespace voxilux
