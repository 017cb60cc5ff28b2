#pragma once

#include <volk.h>

#include "vk/buffer.h"
#include "vk/presenter.h"

namespace voxilux {

// Records the copy of an image of a window that is ready to be presented; `captured` grows where it is short.
void record_capture(const DeviceState& device, VkCommandBuffer commands, VkImage image, glm::ivec2 size,
                    Buffer& captured);

// What was copied, when the commands have run.
[[nodiscard]] WindowCapture copy_capture(const Buffer& captured, glm::ivec2 size, bool is_bgr);

}  // namespace voxilux
