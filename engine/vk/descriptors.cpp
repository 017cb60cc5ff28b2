#include "vk/descriptors.h"

#include <algorithm>
#include <array>
#include <vector>

#include "base/checked_cast.h"
#include "vk/check.h"

namespace voxilux {
namespace {

void grow(const DeviceState& device, Descriptors& descriptors) {
    descriptors.pool.reset();
    const std::uint32_t count = std::max(1u, descriptors.max_buffers);
    const std::array<VkDescriptorPoolSize, 3> sizes{{{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, count},
                                                     {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, count},
                                                     {VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER, count}}};
    const VkDescriptorPoolCreateInfo info{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                          .maxSets = descriptors.max_sets,
                                          .poolSizeCount = sizes.size(),
                                          .pPoolSizes = sizes.data()};
    VkDescriptorPool pool = VK_NULL_HANDLE;
    vk_check(vkCreateDescriptorPool(device.handle, &info, nullptr, &pool), "create the descriptor pool");
    descriptors.pool = {device.handle, pool};
    set_debug_name(device, VK_OBJECT_TYPE_DESCRIPTOR_POOL, to_bits(pool), "executor.descriptors");
}

VkDescriptorBufferInfo buffer_info(const DeviceState& device, const std::string& shader,
                                   const std::string& block, const Buffer& buffer) {
    const std::uint64_t limit = device.info.limits.max_binding_bytes;
    if (buffer.bytes > limit) {
        throw InternalError(
            fmt::format("internal error: shader '{}': buffer '{}' of {} bytes for block '{}' is over the {} "
                        "bytes that one binding may have",
                        shader, buffer.name, buffer.bytes, block, limit));
    }
    return {.buffer = buffer.handle.get(), .offset = 0, .range = buffer.bytes};
}

VkBufferView texels_of(const std::string& shader, const BufferBlock& block, const Buffer& buffer) {
    const UniqueBufferView& view = block.kind == BlockKind::words ? buffer.words : buffer.texels;
    if (!view) {
        throw InternalError(
            fmt::format("internal error: shader '{}': buffer '{}' of {} bytes for texels '{}' has too few of "
                        "them, or more than the device takes",
                        shader, buffer.name, buffer.bytes, block.name));
    }
    return view.get();
}

}  // namespace

void start_descriptors(const DeviceState& device, Descriptors& descriptors,
                       std::span<const PreparedDispatch> dispatches) {
    std::size_t buffers = 0;
    for (const PreparedDispatch& dispatch : dispatches)
        buffers += dispatch.program->info.blocks.size();
    const auto wanted_sets = checked_cast<std::uint32_t>(dispatches.size(), "dispatches");
    const auto wanted_buffers = checked_cast<std::uint32_t>(buffers, "bound buffers");
    if (wanted_sets > descriptors.max_sets || wanted_buffers > descriptors.max_buffers) {
        descriptors.max_sets = std::max(descriptors.max_sets, wanted_sets);
        descriptors.max_buffers = std::max(descriptors.max_buffers, wanted_buffers);
        grow(device, descriptors);
    } else if (descriptors.pool) {
        vk_check(vkResetDescriptorPool(device.handle, descriptors.pool.get(), 0),
                 "reset the descriptor pool");
    }
}

VkDescriptorSet create_set(const DeviceState& device, const Descriptors& descriptors,
                           const PreparedDispatch& dispatch, const BufferStore& buffers) {
    const VkDescriptorSetLayout layout = dispatch.program->set_layout.get();
    const VkDescriptorSetAllocateInfo info{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                                           .descriptorPool = descriptors.pool.get(),
                                           .descriptorSetCount = 1,
                                           .pSetLayouts = &layout};
    VkDescriptorSet set = VK_NULL_HANDLE;
    vk_check(vkAllocateDescriptorSets(device.handle, &info, &set),
             fmt::format("allocate the descriptor set of '{}'", dispatch.dispatch->label));
    set_debug_name(device, VK_OBJECT_TYPE_DESCRIPTOR_SET, to_bits(set), dispatch.dispatch->label);

    const std::vector<BufferBlock>& blocks = dispatch.program->info.blocks;
    std::vector<VkDescriptorBufferInfo> infos;
    infos.reserve(blocks.size());  // the writes point into it
    std::vector<VkBufferView> views;
    views.reserve(blocks.size());
    std::vector<VkWriteDescriptorSet> writes;
    for (const BufferBlock& block : blocks) {
        const auto bound = std::ranges::find(dispatch.dispatch->bindings, block.name, &Binding::block);
        const Buffer& buffer = buffers.at(bound->buffer);
        VkWriteDescriptorSet write{.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                                   .dstSet = set,
                                   .dstBinding = block.binding,
                                   .descriptorCount = 1,
                                   .descriptorType = descriptor_type(block)};
        if (block.kind == BlockKind::texels || block.kind == BlockKind::words) {
            write.pTexelBufferView = &views.emplace_back(texels_of(dispatch.program->name, block, buffer));
        } else {
            write.pBufferInfo =
                &infos.emplace_back(buffer_info(device, dispatch.program->name, block.name, buffer));
        }
        writes.push_back(write);
    }
    vkUpdateDescriptorSets(device.handle, checked_cast<std::uint32_t>(writes.size(), "bindings"),
                           writes.data(), 0, nullptr);
    return set;
}

}  // namespace voxilux
