#pragma once

#include <volk.h>

#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include "vk/device.h"
#include "vk/instance.h"

namespace voxilux {

// What a Device holds. Members are destroyed in reverse order: the device before its instance, the sink last.
struct DeviceState {
    DeviceState() = default;
    DeviceState(const DeviceState&) = delete;
    DeviceState& operator=(const DeviceState&) = delete;
    ~DeviceState();

    mutable MessageSink sink;
    Instance instance;
    DeviceInfo info;
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    VkPhysicalDeviceProperties properties{};
    VkPhysicalDeviceMemoryProperties memory{};
    std::string uuid_hex;  // pipelineCacheUUID
    std::uint32_t timestamp_bits = 0;
    std::vector<std::uint32_t> missing_capabilities;  // SPIR-V capabilities that no shader may use here
    std::uint32_t family = 0;
    VkDevice handle = VK_NULL_HANDLE;
    VkQueue queue = VK_NULL_HANDLE;
};

// A handle as an integer for debug names, whether Vulkan defines it as a pointer or as an integer.
template <class Handle>
[[nodiscard]] std::uint64_t to_bits(Handle handle) {
    return std::bit_cast<std::uint64_t>(handle);
}

// Gives a Vulkan object the name that tools and validation messages show. Does nothing without
// VK_EXT_debug_utils.
void set_debug_name(const DeviceState& device, VkObjectType type, std::uint64_t handle,
                    const std::string& name);

}  // namespace voxilux
