#include "vk/buffer.h"

#include <algorithm>
#include <array>
#include <optional>
#include <span>

#include "base/error.h"
#include "vk/check.h"

namespace voxilux {
namespace {

constexpr VkMemoryPropertyFlags kHost =
    VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
constexpr VkMemoryPropertyFlags kCachedHost = kHost | VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
constexpr VkMemoryPropertyFlags kLocal = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;

// Preferred kinds of memory, best first. Mapped memory of a discrete GPU is not cached, so reading it is very
// slow: such a GPU gets unmapped memory although some of its types can be mapped.
constexpr std::array kDeviceWishes{kLocal | kCachedHost, kLocal, kCachedHost, kHost};
constexpr std::array kStagingWishes{kCachedHost, kHost};

std::uint32_t choose_type(const DeviceState& device, std::uint32_t allowed,
                          std::span<const VkMemoryPropertyFlags> wishes, const std::string& name) {
    for (const VkMemoryPropertyFlags wish : wishes) {
        for (std::uint32_t type = 0; type < device.memory.memoryTypeCount; ++type) {
            const bool is_allowed = ((allowed >> type) & 1u) != 0;
            if (is_allowed && (device.memory.memoryTypes[type].propertyFlags & wish) == wish) return type;
        }
    }
    throw Error(ExitCode::no_device,
                fmt::format("device '{}' has no memory for buffer '{}'", device.info.name, name));
}

constexpr VkBufferUsageFlags kUsage =
    VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_STORAGE_TEXEL_BUFFER_BIT |
    VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT |
    VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT |
    VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;

// Gives the buffer memory of this type, mapped when it is cached host memory.
void add_memory(const DeviceState& device, std::uint64_t bytes, std::uint32_t type, Buffer& buffer) {
    const std::string what = fmt::format("buffer '{}' ({} bytes)", buffer.name, buffer.bytes);
    const VkMemoryAllocateFlagsInfo flags{.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO,
                                          .flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT};
    const VkMemoryAllocateInfo allocation{.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                          .pNext = &flags,
                                          .allocationSize = bytes,
                                          .memoryTypeIndex = type};
    VkDeviceMemory memory = VK_NULL_HANDLE;
    vk_check(vkAllocateMemory(device.handle, &allocation, nullptr, &memory), "allocate " + what);
    buffer.memory = {device.handle, memory};
    vk_check(vkBindBufferMemory(device.handle, buffer.handle.get(), memory, 0), "bind the memory of " + what);
    if ((device.memory.memoryTypes[type].propertyFlags & kCachedHost) == kCachedHost) {
        void* mapped = nullptr;
        vk_check(vkMapMemory(device.handle, memory, 0, VK_WHOLE_SIZE, 0, &mapped), "map " + what);
        buffer.mapped = static_cast<std::byte*>(mapped);
    }
    const VkBufferDeviceAddressInfo info{.sType = VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO,
                                         .buffer = buffer.handle.get()};
    buffer.address = vkGetBufferDeviceAddress(device.handle, &info);
    set_debug_name(device, VK_OBJECT_TYPE_DEVICE_MEMORY, to_bits(memory), buffer.name);
}

constexpr std::uint64_t kTexelBytes = 16;
constexpr std::uint64_t kWordBytes = 4;

UniqueBufferView view_texels(const DeviceState& device, const Buffer& buffer, VkFormat format,
                             std::uint64_t texel_bytes) {
    const std::uint64_t texels = buffer.bytes / texel_bytes;
    if (texels == 0 || texels > device.properties.limits.maxTexelBufferElements) return {};
    const VkBufferViewCreateInfo info{.sType = VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO,
                                      .buffer = buffer.handle.get(),
                                      .format = format,
                                      .range = texels * texel_bytes};
    VkBufferView view = VK_NULL_HANDLE;
    vk_check(vkCreateBufferView(device.handle, &info, nullptr, &view),
             fmt::format("view the texels of buffer '{}'", buffer.name));
    set_debug_name(device, VK_OBJECT_TYPE_BUFFER_VIEW, to_bits(view), buffer.name);
    return {device.handle, view};
}

Buffer create(const DeviceState& device, const std::string& name, std::uint64_t bytes,
              std::span<const VkMemoryPropertyFlags> wishes) {
    const std::string what = fmt::format("buffer '{}' ({} bytes)", name, bytes);
    if (bytes > device.info.limits.max_allocation_bytes) {
        throw Error(ExitCode::out_of_memory,
                    fmt::format("out of memory: {} is over the {} bytes that device '{}' allocates at once",
                                what, device.info.limits.max_allocation_bytes, device.info.name));
    }
    Buffer buffer{.name = name, .bytes = bytes};
    const VkBufferCreateInfo info{.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
                                  .size = (bytes + 3) / 4 * 4,  // fills work on whole words
                                  .usage = kUsage};
    VkBuffer handle = VK_NULL_HANDLE;
    vk_check(vkCreateBuffer(device.handle, &info, nullptr, &handle), "create " + what);
    buffer.handle = {device.handle, handle};

    VkMemoryRequirements needs;
    vkGetBufferMemoryRequirements(device.handle, handle, &needs);
    add_memory(device, needs.size, choose_type(device, needs.memoryTypeBits, wishes, name), buffer);
    set_debug_name(device, VK_OBJECT_TYPE_BUFFER, to_bits(handle), name);
    buffer.texels = view_texels(device, buffer, VK_FORMAT_R32G32B32A32_UINT, kTexelBytes);
    buffer.words = view_texels(device, buffer, VK_FORMAT_R32_UINT, kWordBytes);
    return buffer;
}

}  // namespace

Buffer create_buffer(const DeviceState& device, const std::string& name, std::uint64_t bytes) {
    return create(device, name, bytes, kDeviceWishes);
}

Buffer create_staging_buffer(const DeviceState& device, const std::string& name, std::uint64_t bytes) {
    return create(device, name, bytes, kStagingWishes);
}

}  // namespace voxilux
