#include "vk/window_capture.h"

#include "vk/window_image.h"

namespace voxilux {

void record_capture(const DeviceState& device, VkCommandBuffer commands, VkImage image, glm::ivec2 size,
                    Buffer& captured) {
    const auto width = static_cast<std::uint32_t>(size.x);
    const auto height = static_cast<std::uint32_t>(size.y);
    const std::uint64_t bytes = std::uint64_t{4} * width * height;
    if (captured.bytes < bytes) captured = create_staging_buffer(device, "window.capture", bytes);
    record_layout(commands, image, VK_IMAGE_LAYOUT_PRESENT_SRC_KHR, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
    const VkBufferImageCopy region{
        .imageSubresource = {.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT, .layerCount = 1},
        .imageExtent = {width, height, 1}};
    vkCmdCopyImageToBuffer(commands, image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, captured.handle.get(), 1,
                           &region);
    record_layout(commands, image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, VK_IMAGE_LAYOUT_PRESENT_SRC_KHR);
    const VkMemoryBarrier to_host{.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER,
                                  .srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT,
                                  .dstAccessMask = VK_ACCESS_HOST_READ_BIT};
    vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &to_host,
                         0, nullptr, 0, nullptr);
}

WindowCapture copy_capture(const Buffer& captured, glm::ivec2 size, bool is_bgr) {
    WindowCapture capture{.size = size};
    const std::size_t pixels = static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y);
    const std::size_t red = is_bgr ? 2 : 0;
    capture.rgb.resize(3 * pixels);
    for (std::size_t i = 0; i < pixels; ++i) {
        const std::byte* const pixel = captured.mapped + 4 * i;
        capture.rgb[3 * i] = static_cast<std::uint8_t>(pixel[red]);
        capture.rgb[3 * i + 1] = static_cast<std::uint8_t>(pixel[1]);
        capture.rgb[3 * i + 2] = static_cast<std::uint8_t>(pixel[2 - red]);
    }
    return capture;
}

}  // namespace voxilux
