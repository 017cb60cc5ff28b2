#pragma once

#include <volk.h>

#include <glm/glm.hpp>

#include "vk/device_state.h"
#include "vk/handle.h"

namespace voxilux {

// An image of the format of a window that pictures are copied to before they are scaled.
struct WindowImage {
    UniqueMemory memory;  // outlives the handle
    UniqueImage handle;
    glm::ivec2 size{0};  // pixels
};

// Its contents are undefined. Throws Error(out_of_memory).
[[nodiscard]] WindowImage create_window_image(const DeviceState& device, VkFormat format, glm::ivec2 size);

// Waits for all that was recorded before and changes the layout of the image.
void record_layout(VkCommandBuffer commands, VkImage image, VkImageLayout from, VkImageLayout to);

// Copies words of the image's format; its layout is that of a destination.
void record_copy(VkCommandBuffer commands, VkBuffer from, VkImage to, glm::ivec2 size);

// Copies an image whose layout is that of a source to all of one that is a destination, filtered.
void record_scaled_copy(VkCommandBuffer commands, const WindowImage& from, VkImage to, glm::ivec2 to_size);

}  // namespace voxilux
