#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "embedded.h"
#include "record/recording.h"
#include "vk/device.h"
#include "vk/pass_time.h"
#include "vk/spirv_reflect.h"

namespace voxilux {

struct ExecutorOptions {
    std::filesystem::path cache_dir;                // of the pipeline cache; empty: none
    std::array<std::uint32_t, 2> group_size{8, 8};  // for shaders whose local x and y are both constants
    bool time_dispatches = true;
    bool poison_transients = false;  // fills transient buffers with 0xCDCDCDCD first, to find undefined reads
    std::uint64_t staging_bytes = std::uint64_t{32} << 20;  // longer transfers are split into such pieces
};

struct RunResult {
    std::map<std::string, std::vector<std::byte>> readbacks;  // by buffer
    std::vector<PassTime> passes;                             // in order of first dispatch
};

// The values of a buffer that was read back.
template <class T>
[[nodiscard]] std::vector<T> values_of(const RunResult& result, const std::string& buffer) {
    static_assert(std::is_trivially_copyable_v<T>);
    const std::vector<std::byte>& bytes = result.readbacks.at(buffer);
    std::vector<T> values(bytes.size() / sizeof(T));
    std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
    return values;
}

struct MemoryRow {
    std::string buffer;
    std::uint64_t bytes = 0;
};

struct Buffer;
struct ExecutorState;

// Runs Recordings on a device: creates the buffers that they declare, the pipelines that they name and the
// barriers between their commands. Persistent buffers live from run to run by name; one that is declared with
// another size is created anew.
class Executor {
  public:
    // Dispatches find their shaders by name in `shaders`; each is compiled when it is first dispatched.
    Executor(Device& device, std::span<const EmbeddedShader> shaders, ExecutorOptions options = {});
    Executor(Executor&&) noexcept;
    Executor& operator=(Executor&&) noexcept;
    ~Executor();

    // Runs the commands in order, waits, and returns what was read back and the times. Throws InternalError
    // that names the shader when a dispatch does not fit it (unknown shader, block, pointer or constant,
    // missing block or pointer, push size, extent), Error(out_of_memory) that names the buffer,
    // Error(device_lost), Error(usage) for a group size that the device cannot run.
    RunResult run(const Recording& recording);

    // The buffers that exist now, by name.
    [[nodiscard]] std::vector<MemoryRow> memory() const;

    // Every buffer that a run has needed so far, by name, in its last size, and the staging memory.
    [[nodiscard]] std::vector<MemoryRow> needed_memory() const;

    // Pipelines made since construction.
    [[nodiscard]] std::uint64_t pipelines_created() const;

    // For this room only: a buffer that exists.
    [[nodiscard]] const Buffer& buffer(std::string_view name) const;

  private:
    std::unique_ptr<ExecutorState> state_;
};

}  // namespace voxilux
