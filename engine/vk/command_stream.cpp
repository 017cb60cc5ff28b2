#include "vk/command_stream.h"

#include <algorithm>
#include <cstring>
#include <limits>

#include "base/assert.h"
#include "vk/check.h"

namespace voxilux {
namespace {

// Pieces of transfers start at multiples of this in staging memory, so that copies move whole words.
constexpr std::uint64_t kStagingAlignment = 16;

std::uint64_t round_up(std::uint64_t bytes) {
    return (bytes + kStagingAlignment - 1) / kStagingAlignment * kStagingAlignment;
}

}  // namespace

CommandStream::CommandStream(const DeviceState& device, std::uint64_t staging_bytes)
    : device_(&device), staging_limit_(staging_bytes) {
    VX_ASSERT(staging_bytes >= kStagingAlignment && staging_bytes % kStagingAlignment == 0);
    const VkCommandPoolCreateInfo pool_info{.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                            .flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT,
                                            .queueFamilyIndex = device.family};
    VkCommandPool pool = VK_NULL_HANDLE;
    vk_check(vkCreateCommandPool(device.handle, &pool_info, nullptr, &pool), "create the command pool");
    pool_ = {device.handle, pool};
    const VkCommandBufferAllocateInfo info{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                           .commandPool = pool,
                                           .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                           .commandBufferCount = 1};
    vk_check(vkAllocateCommandBuffers(device.handle, &info, &commands_), "allocate the command buffer");
    set_debug_name(device, VK_OBJECT_TYPE_COMMAND_BUFFER, to_bits(commands_), "executor.commands");
    const VkFenceCreateInfo fence_info{.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
    VkFence fence = VK_NULL_HANDLE;
    vk_check(vkCreateFence(device.handle, &fence_info, nullptr, &fence), "create the fence");
    fence_ = {device.handle, fence};
}

void CommandStream::begin(std::uint64_t transfer_bytes) {
    pending_.clear();
    const std::uint64_t wanted = std::min(round_up(transfer_bytes), staging_limit_);
    if (staging_.bytes < wanted) {
        staging_ = {};
        staging_ = create_staging_buffer(*device_, "executor.staging", wanted);
    }
    start_recording();
}

void CommandStream::finish() {
    submit();
}

void CommandStream::start_recording() {
    staging_used_ = 0;
    vk_check(vkResetCommandPool(device_->handle, pool_.get(), 0), "reset the command pool");
    const VkCommandBufferBeginInfo info{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                        .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT};
    vk_check(vkBeginCommandBuffer(commands_, &info), "begin the commands");
}

void CommandStream::submit() {
    if (!pending_.empty()) {
        const VkMemoryBarrier to_host{.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER,
                                      .srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT,
                                      .dstAccessMask = VK_ACCESS_HOST_READ_BIT};
        vkCmdPipelineBarrier(commands_, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1,
                             &to_host, 0, nullptr, 0, nullptr);
    }
    vk_check(vkEndCommandBuffer(commands_), "end the commands");
    const VkFence fence = fence_.get();
    const VkSubmitInfo info{
        .sType = VK_STRUCTURE_TYPE_SUBMIT_INFO, .commandBufferCount = 1, .pCommandBuffers = &commands_};
    vk_check(vkQueueSubmit(device_->queue, 1, &info, fence), "submit the commands");
    vk_check(vkWaitForFences(device_->handle, 1, &fence, VK_TRUE, std::numeric_limits<std::uint64_t>::max()),
             "wait for the commands");
    vk_check(vkResetFences(device_->handle, 1, &fence), "reset the fence");
    for (const Pending& one : pending_)
        std::memcpy(one.data.data(), staging_.mapped + one.staging_offset, one.data.size());
    pending_.clear();
}

// Staging bytes for the next piece of a transfer, at least one and at most `wanted_bytes`.
std::uint64_t CommandStream::reserve(std::uint64_t wanted_bytes) {
    VX_ASSERT(staging_.bytes > 0);
    if (staging_used_ == staging_.bytes) {
        submit();
        start_recording();
    }
    return std::min(wanted_bytes, staging_.bytes - staging_used_);
}

void CommandStream::advance(std::uint64_t bytes) {
    staging_used_ = std::min(staging_.bytes, staging_used_ + round_up(bytes));
}

void CommandStream::upload(const Buffer& buffer, std::uint64_t offset_bytes,
                           std::span<const std::byte> data) {
    while (!data.empty()) {
        const std::uint64_t piece = reserve(data.size());
        std::memcpy(staging_.mapped + staging_used_, data.data(), piece);
        const VkBufferCopy region{.srcOffset = staging_used_, .dstOffset = offset_bytes, .size = piece};
        vkCmdCopyBuffer(commands_, staging_.handle.get(), buffer.handle.get(), 1, &region);
        advance(piece);
        offset_bytes += piece;
        data = data.subspan(piece);
    }
}

void CommandStream::readback(const Buffer& buffer, std::uint64_t offset_bytes, std::span<std::byte> data) {
    while (!data.empty()) {
        const std::uint64_t piece = reserve(data.size());
        const VkBufferCopy region{.srcOffset = offset_bytes, .dstOffset = staging_used_, .size = piece};
        vkCmdCopyBuffer(commands_, buffer.handle.get(), staging_.handle.get(), 1, &region);
        pending_.push_back({staging_used_, data.first(piece)});
        advance(piece);
        offset_bytes += piece;
        data = data.subspan(piece);
    }
}

}  // namespace voxilux
