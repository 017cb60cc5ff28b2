#include "vk/instance.h"

#include <algorithm>
#include <cstring>

#include "base/error.h"
#include "vk/check.h"
#include "vk/device.h"

namespace voxilux {
namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

bool has_layer(const char* name) {
    std::uint32_t count = 0;
    vk_check(vkEnumerateInstanceLayerProperties(&count, nullptr), "count instance layers");
    std::vector<VkLayerProperties> layers(count);
    vk_check(vkEnumerateInstanceLayerProperties(&count, layers.data()), "list instance layers");
    return std::ranges::any_of(layers,
                               [&](const auto& layer) { return std::strcmp(layer.layerName, name) == 0; });
}

bool has_extension(const char* name) {
    std::uint32_t count = 0;
    vk_check(vkEnumerateInstanceExtensionProperties(nullptr, &count, nullptr), "count instance extensions");
    std::vector<VkExtensionProperties> extensions(count);
    vk_check(vkEnumerateInstanceExtensionProperties(nullptr, &count, extensions.data()),
             "list instance extensions");
    return std::ranges::any_of(extensions,
                               [&](const auto& one) { return std::strcmp(one.extensionName, name) == 0; });
}

VKAPI_ATTR VkBool32 VKAPI_CALL collect_message(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                               VkDebugUtilsMessageTypeFlagsEXT,
                                               const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
    auto& sink = *static_cast<MessageSink*>(user);
    const std::lock_guard lock(sink.mutex);
    sink.messages.emplace_back(data->pMessage != nullptr ? data->pMessage : "");
    if (sink.on_message) sink.on_message(sink.messages.back());
    return VK_FALSE;
}

VkDebugUtilsMessengerCreateInfoEXT messenger_info(MessageSink* sink) {
    VkDebugUtilsMessengerCreateInfoEXT info{VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT};
    info.messageSeverity =
        VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    // Messages of the type "general" come from the loader, about drivers for other hardware.
    info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
    info.pfnUserCallback = collect_message;
    info.pUserData = sink;
    return info;
}

void load_loader() {
    if (volkInitialize() == VK_SUCCESS) return;
    throw Error(ExitCode::no_device,
                "no Vulkan loader on this machine; install one with a software device (Debian: apt install "
                "libvulkan1 mesa-vulkan-drivers)");
}

// The loader answers "incompatible driver" when it finds no driver at all.
void check_created(VkResult result) {
    if (result == VK_ERROR_INCOMPATIBLE_DRIVER) {
        throw Error(ExitCode::no_device,
                    "no Vulkan driver on this machine; the software one always works (Debian: apt install "
                    "mesa-vulkan-drivers)");
    }
    if (result == VK_ERROR_EXTENSION_NOT_PRESENT)
        throw Error(ExitCode::no_device, "the Vulkan loader cannot present to this window system");
    vk_check(result, "create the Vulkan instance");
}

}  // namespace

Instance create_instance(bool validation, MessageSink* sink, std::span<const std::string> more_extensions) {
    load_loader();
    if (validation && !has_layer(kValidationLayer)) {
        throw Error(ExitCode::no_device,
                    "validation was asked for but its layer is not installed (Debian: apt install "
                    "vulkan-validationlayers), or run without validation");
    }
    Instance instance;
    instance.has_debug_utils_ = validation || has_extension(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    const VkApplicationInfo application{.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
                                        .pApplicationName = "voxilux",
                                        .pEngineName = "voxilux",
                                        .apiVersion = VK_API_VERSION_1_3};
    const VkValidationFeatureEnableEXT synchronization =
        VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
    VkDebugUtilsMessengerCreateInfoEXT messenger = messenger_info(sink);
    const VkValidationFeaturesEXT features{.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT,
                                           .pNext = &messenger,
                                           .enabledValidationFeatureCount = 1,
                                           .pEnabledValidationFeatures = &synchronization};
    std::vector<const char*> extensions;
    if (instance.has_debug_utils_) extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    if (validation) extensions.push_back(VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME);
    for (const std::string& name : more_extensions)
        extensions.push_back(name.c_str());
    VkInstanceCreateInfo info{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
    info.pNext = validation ? &features : nullptr;
    info.pApplicationInfo = &application;
    info.enabledLayerCount = validation ? 1 : 0;
    info.ppEnabledLayerNames = &kValidationLayer;
    info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();
    check_created(vkCreateInstance(&info, nullptr, &instance.handle_));
    volkLoadInstance(instance.handle_);
    if (validation) {
        vk_check(vkCreateDebugUtilsMessengerEXT(instance.handle_, &messenger, nullptr, &instance.messenger_),
                 "create the validation messenger");
    }
    return instance;
}

Instance::Instance(Instance&& other) noexcept {
    *this = std::move(other);
}

Instance& Instance::operator=(Instance&& other) noexcept {
    std::swap(handle_, other.handle_);
    std::swap(messenger_, other.messenger_);
    std::swap(has_debug_utils_, other.has_debug_utils_);
    return *this;
}

Instance::~Instance() {
    if (messenger_ != VK_NULL_HANDLE) vkDestroyDebugUtilsMessengerEXT(handle_, messenger_, nullptr);
    if (handle_ != VK_NULL_HANDLE) vkDestroyInstance(handle_, nullptr);
}

std::string loader_version() {
    if (volkInitialize() != VK_SUCCESS) return "none";
    const std::uint32_t version = volkGetInstanceVersion();
    return fmt::format("{}.{}.{}", VK_API_VERSION_MAJOR(version), VK_API_VERSION_MINOR(version),
                       VK_API_VERSION_PATCH(version));
}

}  // namespace voxilux
