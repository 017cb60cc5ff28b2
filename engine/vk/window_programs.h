#pragma once

#include <volk.h>

#include <array>
#include <span>

#include "embedded.h"
#include "vk/device_state.h"
#include "vk/handle.h"

namespace voxilux {

// Storage buffers that the shaders of a window read, by binding.
enum class WindowBuffer : std::uint8_t { picture, font, vertices, indices };
inline constexpr std::size_t kWindowBuffers = 4;

// The two pipelines that draw a window, and the one descriptor set that both read.
struct WindowPrograms {
    UniqueSetLayout set_layout;
    UniquePipelineLayout layout;
    UniqueDescriptorPool pool;
    VkDescriptorSet set = VK_NULL_HANDLE;
    UniquePipeline picture;
    UniquePipeline overlay;  // blended over what is there
};

[[nodiscard]] WindowPrograms create_window_programs(const DeviceState& device,
                                                    std::span<const EmbeddedShader> shaders,
                                                    VkRenderPass pass);

}  // namespace voxilux
