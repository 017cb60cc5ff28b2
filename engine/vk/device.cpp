#include "vk/device.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <optional>

#include "base/checked_cast.h"
#include "base/error.h"
#include "vk/check.h"
#include "vk/device_state.h"
#include "vk/physical.h"

namespace voxilux {
namespace {

std::string lower(std::string_view text) {
    std::string result(text);
    std::ranges::transform(result, result.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return result;
}

// The first of its `lacks` says what keeps the device from being used.
std::string first_lack(const DeviceInfo& device) {
    return device.lacks.empty() ? "a lack: it cannot be used" : device.lacks.front();
}

std::string one_line(std::span<const DeviceInfo> devices) {
    std::string text;
    for (const DeviceInfo& device : devices)
        text += fmt::format("{}{}: {}{}", text.empty() ? "" : ", ", device.index, device.name,
                            device.usable ? "" : fmt::format(" ({})", first_lack(device)));
    return text.empty() ? "none" : text;
}

std::optional<std::uint32_t> as_index(std::string_view text) {
    std::uint32_t index = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), index);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return index;
}

// Real GPUs before CPUs; among GPUs, discrete before integrated before the rest.
int rank(const DeviceInfo& device) {
    if (device.type == "discrete") return 0;
    if (device.type == "integrated") return 1;
    return device.type == "cpu" ? 3 : 2;
}

std::optional<std::size_t> best_usable(std::span<const DeviceInfo> devices) {
    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < devices.size(); ++i) {
        if (!devices[i].usable) continue;
        if (!best || rank(devices[i]) < rank(devices[*best])) best = i;
    }
    return best;
}

std::optional<std::size_t> find_selected(std::span<const DeviceInfo> devices, std::string_view selector) {
    if (const auto index = as_index(selector)) {
        const auto found = std::ranges::find(devices, *index, &DeviceInfo::index);
        if (found == devices.end()) return std::nullopt;
        return static_cast<std::size_t>(found - devices.begin());
    }
    std::optional<std::size_t> unusable;
    for (std::size_t i = 0; i < devices.size(); ++i) {
        if (lower(devices[i].name).find(lower(selector)) == std::string::npos) continue;
        if (devices[i].usable) return i;
        if (!unusable) unusable = i;
    }
    return unusable;
}

std::vector<DeviceInfo> describe_all(const std::vector<VkPhysicalDevice>& devices) {
    std::vector<DeviceInfo> infos;
    for (std::size_t i = 0; i < devices.size(); ++i)
        infos.push_back(describe_device(devices[i], checked_cast<std::uint32_t>(i, "device index")));
    if (const auto best = best_usable(infos)) infos[*best].would_use = true;
    return infos;
}

bool has_swapchains(VkPhysicalDevice device) {
    std::uint32_t count = 0;
    vk_check(vkEnumerateDeviceExtensionProperties(device, nullptr, &count, nullptr), "count the extensions");
    std::vector<VkExtensionProperties> extensions(count);
    vk_check(vkEnumerateDeviceExtensionProperties(device, nullptr, &count, extensions.data()),
             "list the extensions");
    return std::ranges::any_of(extensions, [](const auto& one) {
        return std::string_view(one.extensionName) == VK_KHR_SWAPCHAIN_EXTENSION_NAME;
    });
}

// Enables every known feature that the device has, and records which SPIR-V capabilities are missing. Robust
// buffer access is enabled with validation only: it costs time on GPUs, and gives stray accesses a defined
// result.
void create_logical_device(DeviceState& state, bool validation, bool presents) {
    FeatureChain offered;
    query_features(state.physical, offered);
    FeatureChain enabled;
    enabled.base.features.robustBufferAccess =
        validation ? offered.base.features.robustBufferAccess : VK_FALSE;
    for (const Feature& feature : known_features()) {
        *feature.member(enabled) = *feature.member(offered);
        if (*feature.member(offered) == VK_FALSE) {
            state.missing_capabilities.insert(state.missing_capabilities.end(), feature.capabilities.begin(),
                                              feature.capabilities.end());
        }
    }
    const float priority = 1.0f;
    const VkDeviceQueueCreateInfo queue{.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                        .queueFamilyIndex = state.family,
                                        .queueCount = 1,
                                        .pQueuePriorities = &priority};
    if (presents && !has_swapchains(state.physical))
        throw Error(ExitCode::no_device, fmt::format("device '{}' cannot present", state.info.name));
    const char* const swapchain = VK_KHR_SWAPCHAIN_EXTENSION_NAME;
    const VkDeviceCreateInfo info{.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                  .pNext = &enabled.base,
                                  .queueCreateInfoCount = 1,
                                  .pQueueCreateInfos = &queue,
                                  .enabledExtensionCount = presents ? 1u : 0u,
                                  .ppEnabledExtensionNames = &swapchain};
    vk_check(vkCreateDevice(state.physical, &info, nullptr, &state.handle),
             fmt::format("open the device '{}'", state.info.name));
    vkGetDeviceQueue(state.handle, state.family, 0, &state.queue);
}

void note_properties(DeviceState& state) {
    vkGetPhysicalDeviceProperties(state.physical, &state.properties);
    vkGetPhysicalDeviceMemoryProperties(state.physical, &state.memory);
    for (const std::uint8_t byte : state.properties.pipelineCacheUUID)
        state.uuid_hex += fmt::format("{:02x}", byte);
    state.family = checked_cast<std::uint32_t>(compute_family(state.physical), "queue family");
    std::uint32_t count = state.family + 1;
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(state.physical, &count, families.data());
    state.timestamp_bits = families.back().timestampValidBits;
}

}  // namespace

Device::Device(std::unique_ptr<DeviceState> state) : state_(std::move(state)) {}
Device::Device(Device&&) noexcept = default;
Device& Device::operator=(Device&&) noexcept = default;
Device::~Device() = default;

DeviceState::~DeviceState() {
    if (handle != VK_NULL_HANDLE) vkDestroyDevice(handle, nullptr);
}

const DeviceInfo& Device::info() const {
    return state_->info;
}

std::vector<std::string> Device::messages() const {
    const std::lock_guard lock(state_->sink.mutex);
    return state_->sink.messages;
}

std::vector<DeviceInfo> list_devices() {
    MessageSink sink;
    const Instance instance = create_instance(false, &sink);
    return describe_all(physical_devices(instance.get()));
}

std::size_t pick_device(std::span<const DeviceInfo> devices, std::string_view selector) {
    const auto best = best_usable(devices);
    if (selector.empty()) {
        if (best) return *best;
        throw Error(
            ExitCode::no_device,
            fmt::format("no usable Vulkan device (found: {}); the software one always works (Debian: apt "
                        "install mesa-vulkan-drivers)",
                        one_line(devices)));
    }
    const auto found = find_selected(devices, selector);
    if (!found) {
        throw Error(ExitCode::usage,
                    fmt::format("--device {}: no such device; there are: {}", selector, one_line(devices)));
    }
    const DeviceInfo& device = devices[*found];
    if (device.usable) return *found;
    throw Error(ExitCode::no_device,
                fmt::format("device {} ({}) has {}", device.index, device.name, first_lack(device)));
}

Device open_device(const DeviceRequest& request) {
    auto state = std::make_unique<DeviceState>();
    state->sink.on_message = request.on_message;
    std::vector<std::string> extensions;
    if (request.surface != nullptr) extensions = request.surface->instance_extensions;
    state->instance = create_instance(request.validation, &state->sink, extensions);
    const auto devices = physical_devices(state->instance.get());
    const auto infos = describe_all(devices);
    const std::size_t chosen = pick_device(infos, request.selector);
    state->physical = devices[chosen];
    state->info = infos[chosen];
    note_properties(*state);
    create_logical_device(*state, request.validation, request.surface != nullptr);
    return Device(std::move(state));
}

void set_debug_name(const DeviceState& device, VkObjectType type, std::uint64_t handle,
                    const std::string& name) {
    if (!device.instance.has_debug_utils()) return;
    const VkDebugUtilsObjectNameInfoEXT info{.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT,
                                             .objectType = type,
                                             .objectHandle = handle,
                                             .pObjectName = name.c_str()};
    vk_check(vkSetDebugUtilsObjectNameEXT(device.handle, &info), "name an object");
}

}  // namespace voxilux
