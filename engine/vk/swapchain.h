#pragma once

#include <volk.h>

#include <cstdint>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include "vk/device_state.h"
#include "vk/handle.h"

namespace voxilux {

// The images of a window, each with the objects needed to draw into it.
struct Swapchain {
    UniqueSwapchain handle;
    VkExtent2D extent{};
    std::vector<VkImage> images;
    std::vector<UniqueImageView> views;
    std::vector<UniqueFramebuffer> framebuffers;
    std::vector<UniqueSemaphore> rendered;  // by image: what presenting it waits for
};

// The format of the window's images: plain 8-bit codes, because shaders encode sRGB themselves. Throws
// Error(no_device) when the device cannot present to the surface.
[[nodiscard]] VkSurfaceFormatKHR choose_surface_format(const DeviceState& device, VkSurfaceKHR surface);

// The render pass that draws over an image of that format. The image's layout is that of a colour attachment
// before, and ready to present after.
[[nodiscard]] UniqueRenderPass create_window_pass(const DeviceState& device, VkFormat format);

// The swapchain for the surface in its current size, or in size `wanted` where the surface leaves that open;
// nothing while the window has no pixels. Replaces `old`.
[[nodiscard]] std::optional<Swapchain> create_swapchain(const DeviceState& device, VkSurfaceKHR surface,
                                                        VkSurfaceFormatKHR format, VkRenderPass pass,
                                                        glm::ivec2 wanted, VkSwapchainKHR old);

[[nodiscard]] UniqueSemaphore create_semaphore(const DeviceState& device);

}  // namespace voxilux
