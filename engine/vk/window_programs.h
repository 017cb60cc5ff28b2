#pragma once

#include <volk.h>

#include <array>
#include <span>

#include "embedded.h"
#include "vk/device_state.h"
#include "vk/handle.h"

namespace voxilux {

// Buffers that the shaders of a window read, by binding.
enum class WindowBuffer : std::uint8_t { font, vertices, indices };
inline constexpr std::size_t kWindowBuffers = 3;
[[nodiscard]] constexpr VkDescriptorType descriptor_type(WindowBuffer buffer) {
    return buffer == WindowBuffer::font ? VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER
                                        : VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
}

// The pipeline that draws triangles over an image, and the descriptor set that it reads.
struct WindowPrograms {
    UniqueSetLayout set_layout;
    UniquePipelineLayout layout;
    UniqueDescriptorPool pool;
    VkDescriptorSet set = VK_NULL_HANDLE;
    UniquePipeline overlay;
};

[[nodiscard]] WindowPrograms create_window_programs(const DeviceState& device,
                                                    std::span<const EmbeddedShader> shaders,
                                                    VkRenderPass pass);

}  // namespace voxilux
