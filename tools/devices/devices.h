#pragma once

#include <string>

#include "flags.h"

namespace voxilux {

struct DevicesCommand {
    std::string json;
};

void add_devices_flags(Flags& flags, DevicesCommand& command);

// Lists the Vulkan devices, which would be used, and what each lacks. no_device when none is usable.
[[nodiscard]] int run_devices(const DevicesCommand& command);

}  // namespace voxilux
