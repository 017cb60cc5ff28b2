#include "vk/check.h"

#include "base/error.h"

namespace voxilux {

std::string_view result_name(VkResult result) {
    switch (result) {
        case VK_SUCCESS:
            return "VK_SUCCESS";
        case VK_NOT_READY:
            return "VK_NOT_READY";
        case VK_TIMEOUT:
            return "VK_TIMEOUT";
        case VK_INCOMPLETE:
            return "VK_INCOMPLETE";
        case VK_ERROR_OUT_OF_HOST_MEMORY:
            return "VK_ERROR_OUT_OF_HOST_MEMORY";
        case VK_ERROR_OUT_OF_DEVICE_MEMORY:
            return "VK_ERROR_OUT_OF_DEVICE_MEMORY";
        case VK_ERROR_INITIALIZATION_FAILED:
            return "VK_ERROR_INITIALIZATION_FAILED";
        case VK_ERROR_DEVICE_LOST:
            return "VK_ERROR_DEVICE_LOST";
        case VK_ERROR_MEMORY_MAP_FAILED:
            return "VK_ERROR_MEMORY_MAP_FAILED";
        case VK_ERROR_LAYER_NOT_PRESENT:
            return "VK_ERROR_LAYER_NOT_PRESENT";
        case VK_ERROR_EXTENSION_NOT_PRESENT:
            return "VK_ERROR_EXTENSION_NOT_PRESENT";
        case VK_ERROR_FEATURE_NOT_PRESENT:
            return "VK_ERROR_FEATURE_NOT_PRESENT";
        case VK_ERROR_INCOMPATIBLE_DRIVER:
            return "VK_ERROR_INCOMPATIBLE_DRIVER";
        case VK_ERROR_TOO_MANY_OBJECTS:
            return "VK_ERROR_TOO_MANY_OBJECTS";
        case VK_ERROR_OUT_OF_POOL_MEMORY:
            return "VK_ERROR_OUT_OF_POOL_MEMORY";
        case VK_ERROR_UNKNOWN:
            return "VK_ERROR_UNKNOWN";
        case VK_ERROR_INVALID_SHADER_NV:
            return "VK_ERROR_INVALID_SHADER_NV";
        default:
            return "an unknown VkResult";
    }
}

void vk_check(VkResult result, std::string_view what) {
    if (result == VK_SUCCESS) return;
    const std::string cause =
        fmt::format("cannot {}: {} ({})", what, result_name(result), static_cast<int>(result));
    switch (result) {
        case VK_ERROR_DEVICE_LOST:
            throw Error(
                ExitCode::device_lost,
                fmt::format("the device was lost: {}; try again, with less work per dispatch or --device",
                            cause));
        case VK_ERROR_OUT_OF_HOST_MEMORY:
        case VK_ERROR_OUT_OF_DEVICE_MEMORY:
        case VK_ERROR_MEMORY_MAP_FAILED:
        case VK_ERROR_TOO_MANY_OBJECTS:
            throw Error(ExitCode::out_of_memory, fmt::format("out of memory: {}", cause));
        case VK_ERROR_INITIALIZATION_FAILED:
        case VK_ERROR_INCOMPATIBLE_DRIVER:
            throw Error(ExitCode::no_device, fmt::format("the Vulkan driver does not start: {}", cause));
        case VK_ERROR_UNKNOWN:  // lavapipe returns this where it has no memory for its threads
            throw Error(ExitCode::no_device,
                        fmt::format("the Vulkan driver fails and does not say why: {}", cause));
        default:
            throw InternalError(fmt::format("internal error: {}", cause));
    }
}

}  // namespace voxilux
