#pragma once

#include "support.h"

namespace voxilux {

struct PlanCommand {
    SceneOptions scene;
    bool colour_only = false;
    bool verbose = false;
};

CLI::App* add_plan(CLI::App& app, PlanCommand& command);

// Prints what a render of the scene would run, and what not and why. Needs no device.
[[nodiscard]] int run_plan(const PlanCommand& command);

}  // namespace voxilux
