#include "jobs/memory_reserve.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <sstream>

#include "base/error.h"
#include "support/scratch_folder.h"

namespace voxilux {
namespace {

void write(const std::filesystem::path& file, const std::string& text) {
    std::ofstream(file) << text;
}

TEST(MemoryRoom, of_a_control_group_is_what_its_limit_leaves) {
    const ScratchFolder folder;
    EXPECT_EQ(room_of_group(folder.path()), std::nullopt);
    write(folder / "memory.max", "max\n");
    write(folder / "memory.current", "300\n");
    EXPECT_EQ(room_of_group(folder.path()), std::nullopt);
    write(folder / "memory.max", "1000\n");
    EXPECT_EQ(room_of_group(folder.path()), 700u);
    write(folder / "memory.stat", "anon 7\ninactive_file 50\nactive_file 1\n");
    EXPECT_EQ(room_of_group(folder.path()), 750u);
    write(folder / "memory.current", "2000\n");
    EXPECT_EQ(room_of_group(folder.path()), 0u);
}

TEST(MemoryRoom, of_a_control_group_of_the_first_version) {
    const ScratchFolder folder;
    write(folder / "memory.limit_in_bytes", "1000\n");
    write(folder / "memory.usage_in_bytes", "400\n");
    write(folder / "memory.stat", "inactive_file 1\ntotal_inactive_file 100\n");
    EXPECT_EQ(room_of_group(folder.path()), 700u);
}

TEST(MemoryRoom, groups_of_both_versions_and_those_around_them_count) {
    std::istringstream lines("5:cpuset:/x\n4:memory:/a/b\n0::/c\nnonsense\n");
    EXPECT_EQ(memory_groups(lines, "/g"), (std::vector<std::filesystem::path>{"/g/memory/a/b", "/g/memory/a",
                                                                              "/g/memory", "/g/c", "/g"}));
}

TEST(MemoryReserve, more_than_there_is_is_refused_by_name) {
    ASSERT_TRUE(memory_room().has_value()) << "the machine says what it has";
    try {
        const MemoryReserve reserve(std::uint64_t{1} << 60, 0);
        ADD_FAILURE() << "not refused";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::out_of_memory);
        EXPECT_NE(std::string(error.what()).find("writing the picture"), std::string::npos) << error.what();
    }
    EXPECT_THROW(MemoryReserve(0, std::uint64_t{1} << 60), Error);
}

std::uint64_t pages_of_address_space() {
    std::uint64_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    return pages;
}

TEST(MemoryReserve, holds_address_space_until_it_is_released) {
    const std::uint64_t reserved = std::uint64_t{1} << 30;  // far over what else comes and goes
    const std::uint64_t half = reserved / 2 / static_cast<std::uint64_t>(getpagesize());
    const std::uint64_t before = pages_of_address_space();
    MemoryReserve reserve(reserved, 0);
    EXPECT_GT(pages_of_address_space(), before + half);
    reserve.release();
    EXPECT_LT(pages_of_address_space(), before + half);
    reserve.take();
    EXPECT_GT(pages_of_address_space(), before + half);
}

}  // namespace
}  // namespace voxilux
