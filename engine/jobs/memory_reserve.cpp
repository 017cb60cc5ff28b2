#include "jobs/memory_reserve.h"

#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>

#include "base/error.h"

namespace voxilux {
namespace {

// The number after a word in a text of "word number" pairs; nothing where the word is missing.
std::optional<std::uint64_t> number_after(const std::filesystem::path& file, const std::string& word) {
    std::ifstream text(file);
    std::string found;
    std::uint64_t number = 0;
    while (text >> found)
        if (found == word && text >> number) return number;
    return std::nullopt;
}

// Nothing for "max" and for a missing file.
std::optional<std::uint64_t> number_in_file(const std::filesystem::path& file) {
    std::uint64_t number = 0;
    if (std::ifstream text(file); text >> number) return number;
    return std::nullopt;
}

std::uint64_t less(std::uint64_t a, std::uint64_t b) {
    return a > b ? a - b : 0;
}

std::optional<std::uint64_t> room_of_address_space() {
    rlimit limit{};
    const auto pages = number_in_file("/proc/self/statm");
    if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY || !pages) return std::nullopt;
    return less(limit.rlim_cur, *pages * static_cast<std::uint64_t>(getpagesize()));
}

std::optional<std::uint64_t> room_of_machine() {
    const auto available = number_after("/proc/meminfo", "MemAvailable:");
    if (!available) return std::nullopt;
    return (*available + number_after("/proc/meminfo", "SwapFree:").value_or(0)) * 1024;
}

}  // namespace

std::vector<std::filesystem::path> memory_groups(std::istream& lines, const std::filesystem::path& root) {
    std::vector<std::filesystem::path> folders;
    for (std::string line; std::getline(lines, line);) {
        const std::size_t first = line.find(':');
        const std::size_t second = first == std::string::npos ? first : line.find(':', first + 1);
        if (second == std::string::npos) continue;
        const std::string kind = line.substr(first + 1, second - first - 1);
        if (!kind.empty() && kind != "memory") continue;
        const std::filesystem::path top = kind.empty() ? root : root / kind;
        std::filesystem::path inside = std::filesystem::path(line.substr(second + 1)).relative_path();
        for (; !inside.empty(); inside = inside.parent_path())
            folders.push_back(top / inside);
        folders.push_back(top);
    }
    return folders;
}

std::optional<std::uint64_t> room_of_group(const std::filesystem::path& folder) {
    const bool is_first_version = std::filesystem::exists(folder / "memory.limit_in_bytes");
    const auto limit = number_in_file(folder / (is_first_version ? "memory.limit_in_bytes" : "memory.max"));
    const auto used =
        number_in_file(folder / (is_first_version ? "memory.usage_in_bytes" : "memory.current"));
    if (!limit || !used) return std::nullopt;
    const std::string droppable = is_first_version ? "total_inactive_file" : "inactive_file";
    return less(*limit, less(*used, number_after(folder / "memory.stat", droppable).value_or(0)));
}

std::optional<MemoryRoom> memory_room() {
    std::optional<MemoryRoom> least;
    const auto consider = [&](std::optional<std::uint64_t> bytes, const char* limit) {
        if (bytes && (!least || *bytes < least->bytes)) least = MemoryRoom{*bytes, limit};
    };
    consider(room_of_machine(), "the machine");
    consider(room_of_address_space(), "the limit of the process (ulimit -v)");
    std::ifstream groups("/proc/self/cgroup");
    for (const std::filesystem::path& folder : memory_groups(groups, "/sys/fs/cgroup"))
        consider(room_of_group(folder), "the control group of the process");
    return least;
}

MemoryReserve::MemoryReserve(std::uint64_t bytes, std::uint64_t beside) : bytes_(bytes) {
    const auto room = memory_room();
    if (room && room->bytes < bytes + beside)
        throw Error(
            ExitCode::out_of_memory,
            fmt::format("samples need {} MiB of memory and writing the picture {} MiB, but {} leaves {} "
                        "MiB; make the picture smaller",
                        beside >> 20, bytes >> 20, room->limit, room->bytes >> 20));
    take();
}

void MemoryReserve::release() {
    if (held_ != nullptr) munmap(held_, bytes_);
    held_ = nullptr;
}

void MemoryReserve::take() {
    if (held_ != nullptr || bytes_ == 0) return;
    void* const held = mmap(nullptr, bytes_, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    held_ = held == MAP_FAILED ? nullptr : held;
}

}  // namespace voxilux
