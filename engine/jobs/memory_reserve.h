#pragma once

#include <cstdint>
#include <filesystem>
#include <istream>
#include <optional>
#include <string>
#include <vector>

namespace voxilux {

// What still may be allocated on the host, and what limits it.
struct MemoryRoom {
    std::uint64_t bytes = 0;
    std::string limit;  // for a message
};

// The least of what the limit of the address space (RLIMIT_AS), the control groups of the process and the
// memory of the machine leave. Nothing where none of them is known.
[[nodiscard]] std::optional<MemoryRoom> memory_room();

// The folders of a process's control groups and of all groups around them, by the lines of its
// /proc/self/cgroup ("0::/a/b", "4:memory:/a") and where the groups are mounted.
[[nodiscard]] std::vector<std::filesystem::path> memory_groups(std::istream& lines,
                                                               const std::filesystem::path& root);

// What a control group's folder leaves, of version 2 (memory.max) or 1 (memory.limit_in_bytes); pages of
// files that can be dropped are free. Nothing without a limit.
[[nodiscard]] std::optional<std::uint64_t> room_of_group(const std::filesystem::path& folder);

// Keeps memory for the end of a render while samples are taken: address space that nothing else gets, and a
// refusal now rather than a picture that cannot be written then.
class MemoryReserve {
  public:
    // Throws Error(out_of_memory) where there is not so much, and `beside` bytes that the samples will take.
    MemoryReserve(std::uint64_t bytes, std::uint64_t beside);
    ~MemoryReserve() { release(); }
    MemoryReserve(const MemoryReserve&) = delete;
    MemoryReserve& operator=(const MemoryReserve&) = delete;

    // Gives the memory back to whoever needs it; take() asks for it again, and does without where it is gone.
    void release();
    void take();

  private:
    std::uint64_t bytes_;
    void* held_ = nullptr;
};

}  // namespace voxilux
