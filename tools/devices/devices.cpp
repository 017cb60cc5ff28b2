#include "devices/devices.h"

#include <algorithm>

#include "base/error.h"
#include "base/print.h"
#include "shared_flags.h"
#include "vk/device.h"
#include "write_json.h"

namespace voxilux {

void add_devices_flags(Flags& flags, DevicesCommand& command) {
    add_json_flag(flags, command.json, "the list");
}

int run_devices(const DevicesCommand& command) {
    const std::vector<DeviceInfo> devices = list_devices();
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (const DeviceInfo& device : devices) {
        rows.push_back({{"index", device.index},
                        {"name", device.name},
                        {"driver", device.driver},
                        {"type", device.type},
                        {"usable", device.usable},
                        {"would_use", device.would_use},
                        {"lacks", device.lacks},
                        {"max_binding_bytes", device.limits.max_binding_bytes},
                        {"max_allocation_bytes", device.limits.max_allocation_bytes}});
    }
    write_json(command.json, rows);
    if (command.json != "-") {
        for (const DeviceInfo& device : devices) {
            print_result("{} {}  {}  ({}, {}){}\n", device.would_use ? "*" : " ", device.index, device.name,
                         device.type, device.driver, device.usable ? "" : "  not usable");
            for (const std::string& lack : device.lacks)
                print_result("       {}\n", lack);
        }
    }
    const bool any = std::ranges::any_of(devices, &DeviceInfo::usable);
    if (!any)
        throw Error(
            ExitCode::no_device,
            "no usable Vulkan device; install a driver: the package mesa-vulkan-drivers works without a GPU");
    return 0;
}

}  // namespace voxilux
