#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scene_options.h"
#include "shared_flags.h"

namespace voxilux {

struct ViewCommand {
    std::vector<std::string> words;  // of the command line, after the subcommand
    SceneOptions scene;
    DeviceOptions device;
    std::string script;
    std::string screenshot;
    std::string report;
    std::optional<std::int64_t> frames;
    std::string state;  // the file that the window remembers in; empty: that of the user
    std::optional<double> frame_ms;
    std::optional<double> error_target;
    std::optional<double> time_limit_s;
};

void add_view_flags(Flags& flags, ViewCommand& command);

// Shows the scene in a window. Returns done.
[[nodiscard]] int run_view(const ViewCommand& command);

}  // namespace voxilux
