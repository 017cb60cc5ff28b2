#include "view/window_memory.h"

#include <gtest/gtest.h>

#include <fstream>

#include "support/scratch_folder.h"

namespace voxilux::test {
namespace {

TEST(WindowMemory, comes_back_as_it_was_written) {
    const ScratchFolder scratch;
    const std::filesystem::path file = scratch.path() / "new" / "folder" / "window.json";
    write_memory(file, {.size = {640, 480}, .frame_ms = 21.5, .recent = {"/a.vox", "/b.toml"}});
    const WindowMemory memory = read_memory(file);
    EXPECT_EQ(memory.size, glm::ivec2(640, 480));
    EXPECT_EQ(memory.frame_ms, 21.5);
    EXPECT_EQ(memory.recent, (std::vector<std::string>{"/a.vox", "/b.toml"}));
}

TEST(WindowMemory, absent_file_and_numbers_out_of_range_do_no_harm) {
    const ScratchFolder scratch;
    EXPECT_EQ(read_memory(scratch.path() / "none").size, glm::ivec2(0));
    EXPECT_EQ(read_memory("").frame_ms, 33.0);
    std::ofstream(scratch.path() / "a") << R"({"size": [-5, 999999], "frame_ms": 0, "recent": []})";
    EXPECT_EQ(read_memory(scratch.path() / "a").size, glm::ivec2(64, 16384));
    EXPECT_EQ(read_memory(scratch.path() / "a").frame_ms, 1.0);
}

TEST(WindowMemory, ten_files_stay_and_each_once) {
    WindowMemory memory;
    for (int i = 0; i < 14; ++i)
        add_recent("/f" + std::to_string(i % 12) + ".vox", memory);
    ASSERT_EQ(memory.recent.size(), 10u);
    EXPECT_EQ(memory.recent[0], "/f1.vox");
    EXPECT_EQ(memory.recent[1], "/f0.vox");
    EXPECT_EQ(memory.recent[2], "/f11.vox");
}

TEST(WindowMemory, folder_of_the_newest_file_offers_its_other_scenes) {
    const ScratchFolder scratch;
    for (const char* const name : {"a.vox", "b.toml", "c.png", "d.vox"})
        std::ofstream(scratch.path() / name) << name;
    WindowMemory memory;
    EXPECT_TRUE(files_to_open(memory).empty());
    add_recent("/elsewhere/x.vox", memory);
    add_recent(scratch.path() / "a.vox", memory);
    EXPECT_EQ(files_to_open(memory),
              (std::vector<std::string>{"/elsewhere/x.vox", (scratch.path() / "b.toml").string(),
                                        (scratch.path() / "d.vox").string()}));
}

}  // namespace
}  // namespace voxilux::test
