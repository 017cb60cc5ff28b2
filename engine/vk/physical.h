#pragma once

#include <volk.h>

#include <cstdint>
#include <string>
#include <vector>

#include "vk/device.h"

namespace voxilux {

// The features that this program knows, in one chain for vkGetPhysicalDeviceFeatures2 and vkCreateDevice. Not
// movable: the chain points into it.
struct FeatureChain {
    FeatureChain();
    FeatureChain(const FeatureChain&) = delete;
    FeatureChain& operator=(const FeatureChain&) = delete;

    VkPhysicalDeviceVulkan12Features v12{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES};
    VkPhysicalDeviceVulkan11Features v11{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_FEATURES};
    VkPhysicalDeviceFeatures2 base{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2};
};

// A feature that shaders use. Without a required one the device cannot be used.
struct Feature {
    const char* lack;  // sentence for DeviceInfo::lacks
    bool is_required = false;
    VkBool32* (*member)(FeatureChain&);
    std::vector<std::uint32_t> capabilities;  // SPIR-V capabilities that need an optional feature
};
[[nodiscard]] const std::vector<Feature>& known_features();

// One sentence for each known feature that is missing in `offered`, either of the required or of the optional
// ones.
[[nodiscard]] std::vector<std::string> missing_features(FeatureChain& offered, bool is_required);

// Fills `chain` with what the device offers; all false below Vulkan 1.2.
void query_features(VkPhysicalDevice device, FeatureChain& chain);

[[nodiscard]] std::vector<VkPhysicalDevice> physical_devices(VkInstance instance);

// Index of a queue family with compute, dedicated ones last; -1 when there is none.
[[nodiscard]] int compute_family(VkPhysicalDevice device);

// The facts of one device; would_use is left false.
[[nodiscard]] DeviceInfo describe_device(VkPhysicalDevice device, std::uint32_t index);

}  // namespace voxilux
