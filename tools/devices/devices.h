#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace voxilux {

struct DevicesCommand {
    std::string json;
};

CLI::App* add_devices(CLI::App& app, DevicesCommand& command);

// Lists the Vulkan devices, which would be used, and what each lacks. no_device when none is usable.
[[nodiscard]] int run_devices(const DevicesCommand& command);

}  // namespace voxilux
