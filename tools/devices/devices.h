#pragma once

#include <string>

#include "flags.h"

namespace voxilux {

struct DevicesCommand {
    std::string json;
};

void add_devices_flags(Flags& flags, DevicesCommand& command);

// Lists the Vulkan devices, marks the one that would be used, and says what each lacks. Returns no_device
// when none is usable.
[[nodiscard]] int run_devices(const DevicesCommand& command);

}  // namespace voxilux
