#pragma once

#include <volk.h>

#include <glm/glm.hpp>

#include "vk/device_state.h"
#include "vk/handle.h"

namespace voxilux {

// An image in the format of a window: the source is copied to it and then scaled.
struct WindowImage {
    UniqueMemory memory;  // outlives the handle
    UniqueImage handle;
    glm::ivec2 size{0};  // pixels
};

// Its contents are undefined. Throws Error(out_of_memory).
[[nodiscard]] WindowImage create_window_image(const DeviceState& device, VkFormat format, glm::ivec2 size);

// Waits for everything recorded before and changes the layout of the image.
void record_layout(VkCommandBuffer commands, VkImage image, VkImageLayout from, VkImageLayout to);

// Copies words in the format of the image, which has the layout of a transfer destination.
void record_copy(VkCommandBuffer commands, VkBuffer from, VkImage to, glm::ivec2 size);

// Copies an image in the layout of a transfer source to the whole of one in that of a destination, filtered.
void record_scaled_copy(VkCommandBuffer commands, const WindowImage& from, VkImage to, glm::ivec2 to_size);

}  // namespace voxilux
