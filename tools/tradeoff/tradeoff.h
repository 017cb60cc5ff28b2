#pragma once

#include <optional>
#include <string>

#include "device_options.h"
#include "scene_options.h"

namespace voxilux {

// The flags of `tradeoff` as typed.
struct TradeoffCommand {
    SceneOptions scene;
    std::string output;
    std::string json;
    DeviceOptions device;
    std::string time_limit = "120s";
    std::string progress = "auto";
    int repeats = 3;
    bool no_page = false;
    bool quiet = false;
};

CLI::App* add_tradeoff(CLI::App& app, TradeoffCommand& command);

// Measures the price list of a scene and writes it into a folder: JSON, CSV, pictures, and a page. Returns
// the exit code. Throws Error.
[[nodiscard]] int run_tradeoff(const TradeoffCommand& command);

}  // namespace voxilux
