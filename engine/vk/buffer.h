#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "vk/device_state.h"
#include "vk/handle.h"

namespace voxilux {

// A buffer with an allocation of its own. `mapped` is null when the host cannot access its memory; `address`
// is the device address for shaders.
struct Buffer {
    std::string name;
    std::uint64_t bytes = 0;
    UniqueMemory memory;
    UniqueBuffer handle;
    UniqueBufferView texels;  // all of it, four words a texel; none where that is over the device's limit
    UniqueBufferView words;   // one word a texel: as many as the device allows
    std::byte* mapped = nullptr;
    std::uint64_t address = 0;
};

// A storage buffer in device memory, mapped when that memory is also cached host memory (software devices,
// shared-memory GPUs). Its contents are undefined. Throws Error(out_of_memory) that names the buffer.
[[nodiscard]] Buffer create_buffer(const DeviceState& device, const std::string& name, std::uint64_t bytes);

// A mapped buffer to copy to and from. Throws Error(out_of_memory) that names the buffer.
[[nodiscard]] Buffer create_staging_buffer(const DeviceState& device, const std::string& name,
                                           std::uint64_t bytes);

}  // namespace voxilux
