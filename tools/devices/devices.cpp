#include "devices/devices.h"

#include <algorithm>

#include "base/error.h"
#include "output_files.h"
#include "vk/device.h"

namespace voxilux {

CLI::App* add_devices(CLI::App& app, DevicesCommand& command) {
    CLI::App* devices = app.add_subcommand("devices", "Vulkan devices, which would be used, what each lacks");
    devices->add_option("--json", command.json, "write the list as JSON; - is standard output")
        ->type_name("FILE");
    return devices;
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
            fmt::print("{} {}  {}  ({}, {}){}\n", device.would_use ? "*" : " ", device.index, device.name,
                       device.type, device.driver, device.usable ? "" : "  not usable");
            for (const std::string& lack : device.lacks)
                fmt::print("       {}\n", lack);
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
