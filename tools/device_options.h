#pragma once

// Flags that say on which device and how carefully: common to the subcommands that render.

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <string>

#include "vk/device.h"

namespace voxilux {

// The flags as typed.
struct DeviceOptions {
    std::string selector;  // index or part of a name; empty: the default
    bool no_cache = false;
    bool validation = VX_VALIDATION_DEFAULT;
    bool no_validation = false;

    [[nodiscard]] DeviceRequest request() const {
        return {.selector = selector, .validation = validation && !no_validation};
    }
    // Where pipelines are kept from run to run; empty: nowhere.
    [[nodiscard]] std::filesystem::path cache_dir() const;
};

inline constexpr const char* kDeviceGroup = "Device";  // of --help

// `caches` are what --no-cache leaves alone, in words.
void add_device_flags(CLI::App& command, DeviceOptions& options, std::uint64_t& memory_budget_mib,
                      const std::string& caches);

}  // namespace voxilux
