#include "vk/swapchain.h"

#include <algorithm>
#include <limits>

#include "base/error.h"
#include "vk/check.h"

namespace voxilux {
namespace {

// Shows the newest image at once, without tearing where the device supports that; the renderer sets the frame
// rate, not the screen.
VkPresentModeKHR choose_present_mode(const DeviceState& device, VkSurfaceKHR surface) {
    std::uint32_t count = 0;
    vk_check(vkGetPhysicalDeviceSurfacePresentModesKHR(device.physical, surface, &count, nullptr),
             "count the present modes");
    std::vector<VkPresentModeKHR> modes(count);
    vk_check(vkGetPhysicalDeviceSurfacePresentModesKHR(device.physical, surface, &count, modes.data()),
             "list the present modes");
    for (const VkPresentModeKHR mode : {VK_PRESENT_MODE_MAILBOX_KHR, VK_PRESENT_MODE_IMMEDIATE_KHR})
        if (std::ranges::find(modes, mode) != modes.end()) return mode;
    return VK_PRESENT_MODE_FIFO_KHR;
}

VkExtent2D extent_for(const VkSurfaceCapabilitiesKHR& limits, glm::ivec2 wanted) {
    if (limits.currentExtent.width != std::numeric_limits<std::uint32_t>::max()) return limits.currentExtent;
    return {std::clamp(static_cast<std::uint32_t>(wanted.x), limits.minImageExtent.width,
                       limits.maxImageExtent.width),
            std::clamp(static_cast<std::uint32_t>(wanted.y), limits.minImageExtent.height,
                       limits.maxImageExtent.height)};
}

VkSwapchainCreateInfoKHR swapchain_info(const VkSurfaceCapabilitiesKHR& limits, VkSurfaceKHR surface,
                                        VkSurfaceFormatKHR format) {
    VkSwapchainCreateInfoKHR info{VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR};
    info.surface = surface;
    info.minImageCount = limits.minImageCount + 1;
    if (limits.maxImageCount != 0) info.minImageCount = std::min(info.minImageCount, limits.maxImageCount);
    info.imageFormat = format.format;
    info.imageColorSpace = format.colorSpace;
    info.imageArrayLayers = 1;
    // Images are copied to it, and screenshots from it.
    info.imageUsage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT |
                      (limits.supportedUsageFlags & VK_IMAGE_USAGE_TRANSFER_SRC_BIT);
    info.imageSharingMode = VK_SHARING_MODE_EXCLUSIVE;
    info.preTransform = limits.currentTransform;
    info.compositeAlpha = VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR;
    info.clipped = VK_TRUE;
    return info;
}

UniqueImageView create_view(const DeviceState& device, VkImage image, VkFormat format) {
    const VkImageViewCreateInfo info{
        .sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
        .image = image,
        .viewType = VK_IMAGE_VIEW_TYPE_2D,
        .format = format,
        .subresourceRange = {.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT, .levelCount = 1, .layerCount = 1}};
    VkImageView view = VK_NULL_HANDLE;
    vk_check(vkCreateImageView(device.handle, &info, nullptr, &view), "view an image of the window");
    return {device.handle, view};
}

UniqueFramebuffer create_framebuffer(const DeviceState& device, VkImageView view, VkExtent2D extent,
                                     VkRenderPass pass) {
    const VkFramebufferCreateInfo info{.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO,
                                       .renderPass = pass,
                                       .attachmentCount = 1,
                                       .pAttachments = &view,
                                       .width = extent.width,
                                       .height = extent.height,
                                       .layers = 1};
    VkFramebuffer framebuffer = VK_NULL_HANDLE;
    vk_check(vkCreateFramebuffer(device.handle, &info, nullptr, &framebuffer), "create a framebuffer");
    return {device.handle, framebuffer};
}

void add_images(const DeviceState& device, VkFormat format, VkRenderPass pass, Swapchain& swapchain) {
    std::uint32_t count = 0;
    const VkSwapchainKHR handle = swapchain.handle.get();
    vk_check(vkGetSwapchainImagesKHR(device.handle, handle, &count, nullptr), "count the window's images");
    swapchain.images.resize(count);
    vk_check(vkGetSwapchainImagesKHR(device.handle, handle, &count, swapchain.images.data()),
             "list the window's images");
    for (const VkImage image : swapchain.images) {
        swapchain.views.push_back(create_view(device, image, format));
        swapchain.framebuffers.push_back(
            create_framebuffer(device, swapchain.views.back().get(), swapchain.extent, pass));
        swapchain.rendered.push_back(create_semaphore(device));
    }
}

}  // namespace

VkSurfaceFormatKHR choose_surface_format(const DeviceState& device, VkSurfaceKHR surface) {
    VkBool32 presents = VK_FALSE;
    vk_check(vkGetPhysicalDeviceSurfaceSupportKHR(device.physical, device.family, surface, &presents),
             "ask whether the device presents to the window");
    std::uint32_t count = 0;
    vk_check(vkGetPhysicalDeviceSurfaceFormatsKHR(device.physical, surface, &count, nullptr),
             "count the window's formats");
    std::vector<VkSurfaceFormatKHR> formats(count);
    vk_check(vkGetPhysicalDeviceSurfaceFormatsKHR(device.physical, surface, &count, formats.data()),
             "list the window's formats");
    const auto found = std::ranges::find_if(formats, [](const VkSurfaceFormatKHR& one) {
        return one.format == VK_FORMAT_B8G8R8A8_UNORM || one.format == VK_FORMAT_R8G8B8A8_UNORM;
    });
    if (presents == VK_FALSE || found == formats.end())
        throw Error(ExitCode::no_device,
                    fmt::format("device '{}' cannot present to this window", device.info.name));
    return *found;
}

UniqueRenderPass create_window_pass(const DeviceState& device, VkFormat format) {
    const VkAttachmentDescription attachment{.format = format,
                                             .samples = VK_SAMPLE_COUNT_1_BIT,
                                             .loadOp = VK_ATTACHMENT_LOAD_OP_LOAD,
                                             .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
                                             .stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE,
                                             .stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE,
                                             .initialLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                                             .finalLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR};
    const VkAttachmentReference reference{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    const VkSubpassDescription subpass{.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS,
                                       .colorAttachmentCount = 1,
                                       .pColorAttachments = &reference};
    const VkRenderPassCreateInfo info{.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO,
                                      .attachmentCount = 1,
                                      .pAttachments = &attachment,
                                      .subpassCount = 1,
                                      .pSubpasses = &subpass};
    VkRenderPass pass = VK_NULL_HANDLE;
    vk_check(vkCreateRenderPass(device.handle, &info, nullptr, &pass), "create the window's pass");
    return {device.handle, pass};
}

std::optional<Swapchain> create_swapchain(const DeviceState& device, VkSurfaceKHR surface,
                                          VkSurfaceFormatKHR format, VkRenderPass pass, glm::ivec2 wanted,
                                          VkSwapchainKHR old) {
    VkSurfaceCapabilitiesKHR limits;
    vk_check(vkGetPhysicalDeviceSurfaceCapabilitiesKHR(device.physical, surface, &limits),
             "ask for the window's size");
    Swapchain swapchain{.extent = extent_for(limits, wanted)};
    if (swapchain.extent.width == 0 || swapchain.extent.height == 0) return std::nullopt;
    if ((limits.supportedUsageFlags & VK_IMAGE_USAGE_TRANSFER_DST_BIT) == 0)
        throw Error(ExitCode::no_device,
                    fmt::format("device '{}' cannot copy pictures to this window", device.info.name));
    VkSwapchainCreateInfoKHR info = swapchain_info(limits, surface, format);
    info.imageExtent = swapchain.extent;
    info.presentMode = choose_present_mode(device, surface);
    info.oldSwapchain = old;
    VkSwapchainKHR handle = VK_NULL_HANDLE;
    vk_check(vkCreateSwapchainKHR(device.handle, &info, nullptr, &handle), "create the swapchain");
    swapchain.handle = {device.handle, handle};
    add_images(device, format.format, pass, swapchain);
    return swapchain;
}

UniqueSemaphore create_semaphore(const DeviceState& device) {
    const VkSemaphoreCreateInfo info{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO};
    VkSemaphore semaphore = VK_NULL_HANDLE;
    vk_check(vkCreateSemaphore(device.handle, &info, nullptr, &semaphore), "create a semaphore");
    return {device.handle, semaphore};
}

}  // namespace voxilux
