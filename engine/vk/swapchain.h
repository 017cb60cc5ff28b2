#pragma once

#include <volk.h>

#include <cstdint>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include "vk/device_state.h"
#include "vk/handle.h"

namespace voxilux {

// The images of a window, each with what drawing into it takes.
struct Swapchain {
    UniqueSwapchain handle;
    VkExtent2D extent{};
    std::vector<VkImage> images;
    std::vector<UniqueImageView> views;
    std::vector<UniqueFramebuffer> framebuffers;
    std::vector<UniqueSemaphore> rendered;  // by image: what presenting it waits for
};

// How colours are stored in the window: plain 8-bit codes, because shaders encode sRGB themselves. Throws
// Error(no_device) when the device cannot present to the surface.
[[nodiscard]] VkSurfaceFormatKHR choose_surface_format(const DeviceState& device, VkSurfaceKHR surface);

// The pass that draws over an image of that format, whose layout is that of a colour attachment, and leaves
// it ready to present.
[[nodiscard]] UniqueRenderPass create_window_pass(const DeviceState& device, VkFormat format);

// The swapchain for the surface as large as it is now, `wanted` where it leaves that open; nothing while the
// window has no pixels. `old` is replaced.
[[nodiscard]] std::optional<Swapchain> create_swapchain(const DeviceState& device, VkSurfaceKHR surface,
                                                        VkSurfaceFormatKHR format, VkRenderPass pass,
                                                        glm::ivec2 wanted, VkSwapchainKHR old);

[[nodiscard]] UniqueSemaphore create_semaphore(const DeviceState& device);

}  // namespace voxilux
