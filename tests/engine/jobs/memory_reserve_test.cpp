#include "jobs/memory_reserve.h"

#include <gtest/gtest.h>

#include <fstream>
#include <limits>

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

TEST(MemoryReserve, holds_address_space_until_it_is_released) {
    MemoryReserve reserve(std::uint64_t{1} << 20, 0);
    reserve.release();
    reserve.release();
    reserve.take();
}

}  // namespace
}  // namespace voxilux
