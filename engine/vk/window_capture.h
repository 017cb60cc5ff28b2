#pragma once

#include <volk.h>

#include "vk/buffer.h"
#include "vk/presenter.h"

namespace voxilux {

// Records a copy of a window's image that is ready to be presented; `captured` grows where it is too small.
void record_capture(const DeviceState& device, VkCommandBuffer commands, VkImage image, glm::ivec2 size,
                    Buffer& captured);

// The copied image, after the commands have run.
[[nodiscard]] WindowCapture copy_capture(const Buffer& captured, glm::ivec2 size, bool is_bgr);

}  // namespace voxilux
