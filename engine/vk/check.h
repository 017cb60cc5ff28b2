#pragma once

#include <volk.h>

#include <string_view>

namespace voxilux {

// The name of the enumerator, "VK_ERROR_DEVICE_LOST".
[[nodiscard]] std::string_view result_name(VkResult result);

// Throws the error that suits a failed call: Error(device_lost), Error(out_of_memory), Error(no_device) for a
// driver that cannot start or gives no reason, else InternalError. `what` names the call and its object:
// "create buffer 'ao.cells' (4096 bytes)".
void vk_check(VkResult result, std::string_view what);

}  // namespace voxilux
