#pragma once

#include <cstdint>
#include <filesystem>
#include <istream>
#include <optional>
#include <string>
#include <vector>

namespace voxilux {

// How much may still be allocated on the host, and what limits it.
struct MemoryRoom {
    std::uint64_t bytes = 0;
    std::string limit;  // for a message
};

// The smallest of what the address space limit (RLIMIT_AS), the control groups of the process and the memory
// of the machine leave. Nothing where none is known.
[[nodiscard]] std::optional<MemoryRoom> memory_room();

// The folders of a process's control groups and of all groups that contain them, from the lines of its
// /proc/self/cgroup ("0::/a/b", "4:memory:/a") and where the groups are mounted.
[[nodiscard]] std::vector<std::filesystem::path> memory_groups(std::istream& lines,
                                                               const std::filesystem::path& root);

// What a control group's folder leaves, in version 2 (memory.max) or 1 (memory.limit_in_bytes). The page
// cache counts as free. Nothing without a limit.
[[nodiscard]] std::optional<std::uint64_t> room_of_group(const std::filesystem::path& folder);

// Reserves memory for the end of a render while samples are taken: address space that nothing else gets. A
// render that could not write its image is refused before it starts.
class MemoryReserve {
  public:
    // Throws Error(out_of_memory) when `bytes`, and the `beside` bytes that samples will take, are not
    // available.
    MemoryReserve(std::uint64_t bytes, std::uint64_t beside);
    ~MemoryReserve() { release(); }
    MemoryReserve(const MemoryReserve&) = delete;
    MemoryReserve& operator=(const MemoryReserve&) = delete;

    // Returns the memory for other uses; take() asks for it again, and goes on without it if it is gone.
    void release();
    void take();

  private:
    std::uint64_t bytes_;
    void* held_ = nullptr;
};

}  // namespace voxilux
