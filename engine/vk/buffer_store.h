#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "record/recording.h"
#include "vk/buffer.h"
#include "vk/executor.h"

namespace voxilux {

// The buffers of an executor by name, kept from run to run: persistent ones for their contents, the others
// because the next run probably needs them again.
class BufferStore {
  public:
    explicit BufferStore(const DeviceState& device) : device_(&device) {}

    // Creates every buffer that the recording declares. A buffer of the same name and size is reused.
    // Transient buffers are freed when many runs in a row did not declare them, or when memory runs out.
    void acquire(const Recording& recording);

    // The buffer must have been declared.
    [[nodiscard]] const Buffer& at(std::string_view name) const;

    [[nodiscard]] std::vector<MemoryRow> rows() const;

    // What recordings have declared so far, each in its last size, even if it has been freed since.
    [[nodiscard]] std::vector<MemoryRow> declared() const;

  private:
    struct Held {
        Buffer buffer;
        bool persistent = false;
        std::uint64_t last_run = 0;
    };

    Buffer create(const BufferProxy& proxy);
    void free_idle(std::uint64_t runs);

    const DeviceState* device_;
    std::map<std::string, Held, std::less<>> held_;
    std::map<std::string, std::uint64_t> declared_;  // bytes
    std::uint64_t run_ = 0;
};

}  // namespace voxilux
