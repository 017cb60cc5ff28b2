#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "vk/buffer.h"
#include "vk/device_state.h"
#include "vk/handle.h"

namespace voxilux {

// Commands on their way to the device, and the staging memory of their transfers. When that memory is full,
// the commands so far are run to make room, so transfers may have any length.
class CommandStream {
  public:
    CommandStream(const DeviceState& device, std::uint64_t staging_bytes);

    // Starts a new stream that will upload and read back about `transfer_bytes`; what an earlier one left
    // unfinished after an exception is dropped.
    void begin(std::uint64_t transfer_bytes);

    // Runs everything recorded since begin() and waits for it.
    void finish();

    [[nodiscard]] VkCommandBuffer commands() const { return commands_; }

    // Copies `data` into the buffer, or from the buffer to `data`, which must live until finish().
    void upload(const Buffer& buffer, std::uint64_t offset_bytes, std::span<const std::byte> data);
    void readback(const Buffer& buffer, std::uint64_t offset_bytes, std::span<std::byte> data);

    // Bytes of staging memory held now.
    [[nodiscard]] std::uint64_t staging_bytes() const { return staging_.bytes; }

  private:
    struct Pending {
        std::uint64_t staging_offset = 0;
        std::span<std::byte> data;
    };

    void submit();
    void start_recording();
    std::uint64_t reserve(std::uint64_t wanted_bytes);
    void advance(std::uint64_t bytes);

    const DeviceState* device_;
    std::uint64_t staging_limit_;
    UniqueCommandPool pool_;
    UniqueFence fence_;
    VkCommandBuffer commands_ = VK_NULL_HANDLE;
    Buffer staging_;
    std::uint64_t staging_used_ = 0;
    std::vector<Pending> pending_;
};

}  // namespace voxilux
