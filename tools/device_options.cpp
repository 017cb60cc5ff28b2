#include "device_options.h"

#include <fmt/format.h>

#include "cache_folder.h"

namespace voxilux {

std::filesystem::path DeviceOptions::cache_dir() const {
    return no_cache ? std::filesystem::path() : cache_folder();
}

void add_device_flags(CLI::App& command, DeviceOptions& options, std::uint64_t& memory_budget_mib,
                      const std::string& caches) {
    command.add_option("--device", options.selector, "index or part of the name, see voxilux devices")
        ->type_name("NAME")
        ->group(kDeviceGroup);
    command
        .add_option("--memory-budget", memory_budget_mib,
                    "most memory on the device, in MiB; 0 is no limit (default 0)")
        ->type_name("N")
        ->group(kDeviceGroup);
    command.add_flag("--no-cache", options.no_cache, fmt::format("neither read nor write {}", caches))
        ->group(kDeviceGroup);
    command.add_flag("--validation", options.validation, "run under the Vulkan validation layers")
        ->group(kDeviceGroup);
    command.add_flag("--no-validation", options.no_validation, "run without them")->group(kDeviceGroup);
}

}  // namespace voxilux
