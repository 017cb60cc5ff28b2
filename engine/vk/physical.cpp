#include "vk/physical.h"

#include <fmt/format.h>

#include <algorithm>

#include "vk/check.h"

namespace voxilux {

FeatureChain::FeatureChain() {
    base.pNext = &v11;
    v11.pNext = &v12;
}

const std::vector<Feature>& known_features() {
    // Worlds are reached by address (shaders/lib/address.glsl), which needs more than the feature of that
    // name. The numbers are SPIR-V capabilities: SPIR-V specification, section 3.31.
    static const std::vector<Feature> features = {
        {"no scalar block layout (scalarBlockLayout)",
         true,
         [](FeatureChain& c) { return &c.v12.scalarBlockLayout; },
         {}},
        {"no buffer device addresses (bufferDeviceAddress)",
         true,
         [](FeatureChain& c) { return &c.v12.bufferDeviceAddress; },
         {}},
        {"no 64-bit integers (shaderInt64)",
         true,
         [](FeatureChain& c) { return &c.base.features.shaderInt64; },
         {}},
        {"no subgroup operations on 64-bit integers (shaderSubgroupExtendedTypes)",
         true,
         [](FeatureChain& c) { return &c.v12.shaderSubgroupExtendedTypes; },
         {}},
        {"no 64-bit atomics (shaderBufferInt64Atomics): exact 64-bit sums of many threads cannot run",
         false,
         [](FeatureChain& c) { return &c.v12.shaderBufferInt64Atomics; },
         {12}},
        {"no doubles (shaderFloat64): double-precision references cannot run on it",
         false,
         [](FeatureChain& c) { return &c.base.features.shaderFloat64; },
         {10}},
        {"no 16-bit integers (shaderInt16)",
         false,
         [](FeatureChain& c) { return &c.base.features.shaderInt16; },
         {22}},
        {"no 8-bit integers (shaderInt8)", false, [](FeatureChain& c) { return &c.v12.shaderInt8; }, {39}},
        {"no 16-bit storage (storageBuffer16BitAccess)",
         false,
         [](FeatureChain& c) { return &c.v11.storageBuffer16BitAccess; },
         {4433}},
        {"no 8-bit storage (storageBuffer8BitAccess)",
         false,
         [](FeatureChain& c) { return &c.v12.storageBuffer8BitAccess; },
         {4448}},
    };
    return features;
}

std::vector<std::string> missing_features(FeatureChain& offered, bool is_required) {
    std::vector<std::string> lacks;
    for (const Feature& feature : known_features()) {
        if (feature.is_required == is_required && *feature.member(offered) == VK_FALSE)
            lacks.emplace_back(feature.lack);
    }
    return lacks;
}

void query_features(VkPhysicalDevice device, FeatureChain& chain) {
    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(device, &properties);
    if (properties.apiVersion >= VK_API_VERSION_1_2) vkGetPhysicalDeviceFeatures2(device, &chain.base);
}

std::vector<VkPhysicalDevice> physical_devices(VkInstance instance) {
    std::uint32_t count = 0;
    vk_check(vkEnumeratePhysicalDevices(instance, &count, nullptr), "count the devices");
    std::vector<VkPhysicalDevice> devices(count);
    vk_check(vkEnumeratePhysicalDevices(instance, &count, devices.data()), "list the devices");
    return devices;
}

namespace {

std::vector<VkQueueFamilyProperties> queue_families(VkPhysicalDevice device) {
    std::uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
    return families;
}

std::string type_name(VkPhysicalDeviceType type) {
    switch (type) {
        case VK_PHYSICAL_DEVICE_TYPE_CPU:
            return "cpu";
        case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
            return "integrated";
        case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
            return "discrete";
        case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
            return "virtual";
        default:
            return "other";
    }
}

std::string version_text(std::uint32_t version) {
    return fmt::format("{}.{}", VK_API_VERSION_MAJOR(version), VK_API_VERSION_MINOR(version));
}

bool has_timestamps(VkPhysicalDevice device, int family) {
    return family >= 0 && queue_families(device)[static_cast<std::size_t>(family)].timestampValidBits > 0;
}

bool has_subgroup_operations(VkPhysicalDevice device) {
    constexpr VkSubgroupFeatureFlags kNeeded =
        VK_SUBGROUP_FEATURE_VOTE_BIT | VK_SUBGROUP_FEATURE_ARITHMETIC_BIT | VK_SUBGROUP_FEATURE_BALLOT_BIT |
        VK_SUBGROUP_FEATURE_SHUFFLE_BIT;
    VkPhysicalDeviceSubgroupProperties subgroups{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES};
    VkPhysicalDeviceProperties2 two{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, &subgroups};
    vkGetPhysicalDeviceProperties2(device, &two);
    return (subgroups.supportedStages & VK_SHADER_STAGE_COMPUTE_BIT) != 0 &&
           (subgroups.supportedOperations & kNeeded) == kNeeded;
}

void judge(VkPhysicalDevice device, std::uint32_t api_version, DeviceInfo& info) {
    const int family = compute_family(device);
    info.usable = true;
    const auto require = [&](bool holds, std::string lack) {
        if (!holds) info.lacks.push_back(std::move(lack) + ": it cannot be used");
        info.usable = info.usable && holds;
    };
    require(family >= 0, "no compute queue");
    require(api_version >= VK_API_VERSION_1_2, "no Vulkan 1.2, only " + version_text(api_version));
    if (!info.usable) return;
    FeatureChain chain;
    query_features(device, chain);
    for (const std::string& lack : missing_features(chain, true))
        require(false, lack);
    require(has_subgroup_operations(device),
            "no votes, sums, ballots or shuffles of subgroups in compute shaders");
    for (const std::string& lack : missing_features(chain, false))
        info.lacks.push_back(lack);
    if (!has_timestamps(device, family)) info.lacks.emplace_back("no timestamps: passes show 0 ms");
}

}  // namespace

int compute_family(VkPhysicalDevice device) {
    const auto families = queue_families(device);
    int best = -1;
    for (std::size_t i = 0; i < families.size(); ++i) {
        if ((families[i].queueFlags & VK_QUEUE_COMPUTE_BIT) == 0) continue;
        if ((families[i].queueFlags & VK_QUEUE_GRAPHICS_BIT) != 0) return static_cast<int>(i);
        if (best < 0) best = static_cast<int>(i);
    }
    return best;
}

DeviceInfo describe_device(VkPhysicalDevice device, std::uint32_t index) {
    VkPhysicalDeviceVulkan12Properties v12{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_PROPERTIES};
    VkPhysicalDeviceMaintenance3Properties allocation{
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES};
    VkPhysicalDeviceSubgroupProperties subgroups{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES};
    VkPhysicalDeviceProperties2 two{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2};
    VkPhysicalDeviceProperties& base = two.properties;
    vkGetPhysicalDeviceProperties(device, &base);
    if (base.apiVersion >= VK_API_VERSION_1_2) {
        two.pNext = &allocation;
        allocation.pNext = &v12;
        v12.pNext = &subgroups;
        vkGetPhysicalDeviceProperties2(device, &two);
    }
    DeviceInfo info{.index = index,
                    .name = base.deviceName,
                    .driver = fmt::format("{} {}", v12.driverName, v12.driverInfo),
                    .type = type_name(base.deviceType)};
    const auto& limits = base.limits;
    info.limits = {.max_binding_bytes = limits.maxStorageBufferRange,
                   .max_allocation_bytes = allocation.maxMemoryAllocationSize,
                   .max_groups = {limits.maxComputeWorkGroupCount[0], limits.maxComputeWorkGroupCount[1],
                                  limits.maxComputeWorkGroupCount[2]},
                   .max_push_bytes = limits.maxPushConstantsSize,
                   .max_texels = limits.maxTexelBufferElements,
                   .subgroup_size = subgroups.subgroupSize,
                   .is_cpu = base.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU,
                   .name = info.name};
    judge(device, base.apiVersion, info);
    return info;
}

}  // namespace voxilux
