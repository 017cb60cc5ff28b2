#pragma once

#include <cstddef>
#include <string>

#include "scene_options.h"
#include "shared_flags.h"

namespace voxilux {

struct TradeoffCommand {
    SceneOptions scene;
    std::string output;  // folder
    ReportOptions report;
    DeviceOptions device;
    double time_limit_s = 120.0;
    ProgressMode progress = ProgressMode::automatic;
    std::size_t repeats = 3;
    bool no_page = false;
};

void add_tradeoff_flags(Flags& flags, TradeoffCommand& command);

// Measures the price list of a scene and writes it into a folder: JSON, CSV, pictures, and a page. Returns
// the exit code. Throws Error.
[[nodiscard]] int run_tradeoff(const TradeoffCommand& command);

}  // namespace voxilux
