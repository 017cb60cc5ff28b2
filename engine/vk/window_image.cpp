#include "vk/window_image.h"

#include "base/error.h"
#include "vk/check.h"

namespace voxilux {
namespace {

constexpr VkImageSubresourceLayers kColors{.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT, .layerCount = 1};

VkExtent3D extent_of(glm::ivec2 size) {
    return {static_cast<std::uint32_t>(size.x), static_cast<std::uint32_t>(size.y), 1};
}

// The index of a device-local memory type where one is allowed, else of the first allowed one.
std::uint32_t choose_image_memory(const DeviceState& device, std::uint32_t allowed) {
    std::uint32_t chosen = VK_MAX_MEMORY_TYPES;
    for (std::uint32_t type = device.memory.memoryTypeCount; type-- > 0;) {
        if (((allowed >> type) & 1u) == 0) continue;
        const bool is_local =
            (device.memory.memoryTypes[type].propertyFlags & VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT) != 0;
        if (is_local) return type;
        chosen = type;
    }
    if (chosen == VK_MAX_MEMORY_TYPES)
        throw Error(ExitCode::no_device,
                    fmt::format("device '{}' has no memory for the window's image", device.info.name));
    return chosen;
}

}  // namespace

WindowImage create_window_image(const DeviceState& device, VkFormat format, glm::ivec2 size) {
    const VkImageCreateInfo info{.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
                                 .imageType = VK_IMAGE_TYPE_2D,
                                 .format = format,
                                 .extent = extent_of(size),
                                 .mipLevels = 1,
                                 .arrayLayers = 1,
                                 .samples = VK_SAMPLE_COUNT_1_BIT,
                                 .tiling = VK_IMAGE_TILING_OPTIMAL,
                                 .usage = VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT};
    VkImage handle = VK_NULL_HANDLE;
    vk_check(vkCreateImage(device.handle, &info, nullptr, &handle), "create the window's image");
    WindowImage image{.handle = {device.handle, handle}, .size = size};
    VkMemoryRequirements needs;
    vkGetImageMemoryRequirements(device.handle, handle, &needs);
    const VkMemoryAllocateInfo allocation{
        .sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
        .allocationSize = needs.size,
        .memoryTypeIndex = choose_image_memory(device, needs.memoryTypeBits)};
    VkDeviceMemory memory = VK_NULL_HANDLE;
    vk_check(vkAllocateMemory(device.handle, &allocation, nullptr, &memory), "allocate the window's image");
    image.memory = {device.handle, memory};
    vk_check(vkBindImageMemory(device.handle, handle, memory, 0), "bind the window's image");
    return image;
}

void record_layout(VkCommandBuffer commands, VkImage image, VkImageLayout from, VkImageLayout to) {
    const VkImageMemoryBarrier barrier{
        .sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER,
        .srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT,
        .dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT,
        .oldLayout = from,
        .newLayout = to,
        .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
        .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
        .image = image,
        .subresourceRange = {.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT, .levelCount = 1, .layerCount = 1}};
    // Also makes visible what shaders wrote in earlier submissions.
    const VkMemoryBarrier all{.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER,
                              .srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT,
                              .dstAccessMask = VK_ACCESS_MEMORY_READ_BIT};
    vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0,
                         1, &all, 0, nullptr, 1, &barrier);
}

void record_copy(VkCommandBuffer commands, VkBuffer from, VkImage to, glm::ivec2 size) {
    const VkBufferImageCopy region{.imageSubresource = kColors, .imageExtent = extent_of(size)};
    vkCmdCopyBufferToImage(commands, from, to, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
}

void record_scaled_copy(VkCommandBuffer commands, const WindowImage& from, VkImage to, glm::ivec2 to_size) {
    const VkImageBlit region{.srcSubresource = kColors,
                             .srcOffsets = {{}, {from.size.x, from.size.y, 1}},
                             .dstSubresource = kColors,
                             .dstOffsets = {{}, {to_size.x, to_size.y, 1}}};
    vkCmdBlitImage(commands, from.handle.get(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, to,
                   VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region, VK_FILTER_LINEAR);
}

}  // namespace voxilux
