#pragma once

#include <volk.h>

#include <utility>

namespace voxilux {

// Owns one Vulkan object, destroyed by `Destroy(device, handle, nullptr)`. Destroy is a reference because the
// loader fills its function pointers in at run time.
template <class Handle, auto& Destroy>
class UniqueHandle {
  public:
    UniqueHandle() = default;
    UniqueHandle(VkDevice device, Handle handle) : device_(device), handle_(handle) {}
    UniqueHandle(UniqueHandle&& other) noexcept
        : device_(other.device_), handle_(std::exchange(other.handle_, Handle{})) {}
    UniqueHandle& operator=(UniqueHandle&& other) noexcept {
        if (this != &other) {
            reset();
            device_ = other.device_;
            handle_ = std::exchange(other.handle_, Handle{});
        }
        return *this;
    }
    ~UniqueHandle() { reset(); }

    [[nodiscard]] Handle get() const { return handle_; }
    explicit operator bool() const { return handle_ != Handle{}; }

    void reset() {
        if (handle_ != Handle{}) Destroy(device_, handle_, nullptr);
        handle_ = Handle{};
    }

  private:
    VkDevice device_ = VK_NULL_HANDLE;
    Handle handle_{};
};

using UniqueBuffer = UniqueHandle<VkBuffer, vkDestroyBuffer>;
using UniqueBufferView = UniqueHandle<VkBufferView, vkDestroyBufferView>;
using UniqueMemory = UniqueHandle<VkDeviceMemory, vkFreeMemory>;
using UniqueShaderModule = UniqueHandle<VkShaderModule, vkDestroyShaderModule>;
using UniqueSetLayout = UniqueHandle<VkDescriptorSetLayout, vkDestroyDescriptorSetLayout>;
using UniquePipelineLayout = UniqueHandle<VkPipelineLayout, vkDestroyPipelineLayout>;
using UniquePipeline = UniqueHandle<VkPipeline, vkDestroyPipeline>;
using UniquePipelineCache = UniqueHandle<VkPipelineCache, vkDestroyPipelineCache>;
using UniqueDescriptorPool = UniqueHandle<VkDescriptorPool, vkDestroyDescriptorPool>;
using UniqueCommandPool = UniqueHandle<VkCommandPool, vkDestroyCommandPool>;
using UniqueFence = UniqueHandle<VkFence, vkDestroyFence>;
using UniqueSwapchain = UniqueHandle<VkSwapchainKHR, vkDestroySwapchainKHR>;
using UniqueImage = UniqueHandle<VkImage, vkDestroyImage>;
using UniqueImageView = UniqueHandle<VkImageView, vkDestroyImageView>;
using UniqueRenderPass = UniqueHandle<VkRenderPass, vkDestroyRenderPass>;
using UniqueFramebuffer = UniqueHandle<VkFramebuffer, vkDestroyFramebuffer>;
using UniqueSemaphore = UniqueHandle<VkSemaphore, vkDestroySemaphore>;
using UniqueQueryPool = UniqueHandle<VkQueryPool, vkDestroyQueryPool>;

}  // namespace voxilux
