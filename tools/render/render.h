#pragma once

#include "support.h"

namespace voxilux {

struct RenderCommand {
    SceneOptions scene;
    std::vector<std::string> outputs;
    std::optional<std::string> time_limit;
    std::optional<std::string> error;
    std::string progress = "auto";
    std::string tone = "filmic";
    float exposure_ev = 0.0f;
    std::string group_size = "8x8";
    bool reproducible = false;
    bool validation = false;
    bool no_cache = false;
    bool quiet = false;
    bool verbose = false;
};

CLI::App* add_render(CLI::App& app, RenderCommand& command);

// Renders and writes the pictures. Returns done, time_limit (before the error target) or interrupted.
[[nodiscard]] int run_render(const RenderCommand& command);

}  // namespace voxilux
