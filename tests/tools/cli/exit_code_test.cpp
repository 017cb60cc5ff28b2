#include <gtest/gtest.h>

#include <csignal>
#include <fstream>

#include "formats/exr.h"
#include "formats/png.h"
#include "support/scratch_folder.h"
#include "tools/cli/child_process.h"
#include "tools/cli/words.h"

namespace voxilux::test {
namespace {

// One voxel on 32 x 18 pixels: the cheapest render that has everything.
Words one_voxel_render(const std::string& output, Words more = {}) {
    return with({"render", scene_file("one_voxel"), "--size", "32x18", "--spp", "2", "-o", output}, more);
}

// A render that no machine finishes. Standard error shows when it has begun.
Words endless_render(const std::string& output) {
    return {"render",     scene_file("one_voxel"),
            "--size",     "32x18",
            "--spp",      "100000000",
            "-o",         output,
            "--progress", "json"};
}

TEST(ExitCodes, render_that_succeeds_ends_with_0) {
    const ScratchFolder scratch;
    const Ending ending = run(one_voxel_render("a.png"), {.folder = scratch.path()});
    EXPECT_EQ(ending.code, 0) << ending.err;
    EXPECT_EQ(names_in(scratch.path()), Words{"a.png"});
}

TEST(ExitCodes, picture_without_a_name_is_called_as_the_scene) {
    const ScratchFolder scratch;
    const Ending ending =
        run({"render", scene_file("one_voxel"), "--size", "8x8", "--spp", "1"}, {.folder = scratch.path()});
    EXPECT_EQ(ending.code, 0) << ending.err;
    EXPECT_EQ(names_in(scratch.path()), Words{"one_voxel.png"});
}

TEST(ExitCodes, time_limit_before_the_error_ends_with_4_and_a_whole_picture) {
    const ScratchFolder scratch;
    const Ending ending = run({"render", scene_file("one_voxel"), "--size", "32x18", "--error", "0.0001%",
                               "--time-limit", "1s", "-o", "a.exr"},
                              {.folder = scratch.path()});
    EXPECT_EQ(ending.code, 4) << ending.err;
    EXPECT_NE(ending.err.find("over the 0.0001% asked for"), std::string::npos) << ending.err;
    const Image image = read_exr(scratch / "a.exr");
    EXPECT_EQ(image.width, 32);
    for (const float samples : image.channels.at("sampleCount.Y").pixels)
        ASSERT_GE(samples, 1.0f);
}

TEST(ExitCodes, error_reached_in_time_ends_with_0) {
    const ScratchFolder scratch;
    const Ending ending = run({"render", scene_file("one_voxel"), "--size", "32x18", "--error", "20%",
                               "--time-limit", "60s", "-o", "a.png"},
                              {.folder = scratch.path()});
    EXPECT_EQ(ending.code, 0) << ending.err;
    EXPECT_NE(ending.out.find("error target reached"), std::string::npos) << ending.out;
}

TEST(ExitCodes, time_limit_alone_is_success) {
    const ScratchFolder scratch;
    const Ending ending = run(one_voxel_render("a.png", {"--spp", "100000000", "--time-limit", "0.5s"}),
                              {.folder = scratch.path()});
    EXPECT_EQ(ending.code, 0) << ending.err;
    EXPECT_NE(ending.out.find("time limit reached"), std::string::npos) << ending.out;
}

TEST(ExitCodes, flag_given_twice_counts_as_given_last) {
    const Ending ending = run({"plan", scene_file("one_voxel"), "--size", "8x8", "--spp", "3", "--spp", "5",
                               "--size", "9x7", "--effect", "ao=off", "--effect", "sun=off"});
    EXPECT_EQ(ending.code, 0) << ending.err;
    EXPECT_EQ(ending.out.find("picture   9x7, 5 samples per pixel"), 0u) << ending.out;
    EXPECT_NE(ending.out.find("ao         off  switched off"), std::string::npos) << "effects add up";
    EXPECT_NE(ending.out.find("sun        off  switched off"), std::string::npos);
}

TEST(ExitCodes, compare_over_a_threshold_ends_with_5) {
    const ScratchFolder scratch;
    Image image = make_image(2, 2, Words{"R", "G", "B"});
    write_png(scratch / "a.png", image);
    image.channels["R"].pixels[0] = 1.0f;
    write_png(scratch / "b.png", image);
    const Words words = {"compare", scratch / "a.png", scratch / "b.png", "--max-abs"};
    Words strict = words, lax = words;
    strict.push_back("0.5");
    lax.push_back("1.5");
    EXPECT_EQ(run(strict).code, 5);
    EXPECT_EQ(run(lax).code, 0);
}

const Surroundings kNoDriver{.environment = {{"VK_ICD_FILENAMES", "/nonexistent/none.json"},
                                             {"VK_DRIVER_FILES", "/nonexistent/none.json"}}};

TEST(ExitCodes, machine_without_a_driver_ends_with_69_and_says_what_to_install) {
    const ScratchFolder scratch;
    for (const Words& words : {one_voxel_render(scratch / "a.png"), Words{"devices"}}) {
        const Ending ending = run(words, kNoDriver);
        EXPECT_EQ(ending.code, 69) << ending.err;
        EXPECT_NE(ending.err.find("mesa-vulkan-drivers"), std::string::npos) << ending.err;
    }
    EXPECT_EQ(names_in(scratch.path()), Words{});
}

TEST(ExitCodes, plan_and_info_need_no_driver) {
    EXPECT_EQ(run({"plan", scene_file("mixed")}, kNoDriver).code, 0);
    EXPECT_EQ(run({"info", scene_file("mixed")}, kNoDriver).code, 0);
}

TEST(ExitCodes, output_that_cannot_be_written_ends_with_73_before_the_work) {
    const ScratchFolder scratch;
    std::filesystem::create_directory(scratch / "folder.exr");
    // /proc takes no new files, not even from root.
    for (const std::string& output :
         {std::string("absent/a.png"), std::string("folder.exr"), std::string("/proc/a.png")}) {
        const Ending ending = run(one_voxel_render(output), {.folder = scratch.path()});
        EXPECT_EQ(ending.code, 73) << output << ": " << ending.err;
        EXPECT_NE(ending.err.find(output + ": cannot write"), std::string::npos) << ending.err;
        EXPECT_EQ(names_in(scratch.path()), Words{"folder.exr"});
    }
    EXPECT_EQ(run(one_voxel_render("a.png", {"--json", "absent/a.json"}), {.folder = scratch.path()}).code,
              73);
    EXPECT_EQ(names_in(scratch.path()), Words{"folder.exr"})
        << "the report is checked before the picture is made";
}

TEST(ExitCodes, full_disk_ends_with_73_and_keeps_the_old_file) {
    const ScratchFolder scratch;
    const Surroundings full_disk{.folder = scratch.path(),
                                 .environment = {{"MESA_SHADER_CACHE_DISABLE", "true"}},
                                 .largest_file = 100};
    const std::vector<std::pair<std::string, Words>> commands = {
        {"a.exr", one_voxel_render("a.exr", {"--no-cache"})},
        {"a.json", {"plan", scene_file("mixed"), "--json", "a.json"}},
        {"a.png", one_voxel_render("a.png", {"--no-cache"})}};
    for (const auto& [output, words] : commands) {
        write_text(scratch / output, "old");
        const Ending ending = run(words, full_disk);
        EXPECT_EQ(ending.code, 73) << output << ": " << ending.err;
        EXPECT_EQ(bytes_of(scratch / output), "old") << output;
    }
    EXPECT_EQ(names_in(scratch.path()), (Words{"a.exr", "a.json", "a.png"})) << "no temporary files";
}

TEST(ExitCodes, device_that_is_full_ends_with_73) {
    EXPECT_EQ(run({"plan", scene_file("mixed"), "--json", "/dev/full"}).code, 73);
    const Ending ending = run({"plan", scene_file("mixed")}, {.output_file = "/dev/full"});
    EXPECT_EQ(ending.code, 73);
    EXPECT_NE(ending.err.find("cannot write to standard output"), std::string::npos) << ending.err;
    EXPECT_EQ(run({"devices"}, {.output_file = "/dev/full"}).code, 73);
}

TEST(ExitCodes, device_is_written_to_and_not_replaced) {
    EXPECT_EQ(run({"plan", scene_file("mixed"), "--json", "/dev/null"}).code, 0);
    EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST(ExitCodes, link_stays_a_link_to_the_new_picture) {
    const ScratchFolder scratch;
    write_text(scratch / "real.png", "old");
    std::filesystem::create_symlink("real.png", scratch / "link.png");
    EXPECT_EQ(run(one_voxel_render("link.png"), {.folder = scratch.path()}).code, 0);
    EXPECT_TRUE(std::filesystem::is_symlink(scratch / "link.png"));
    EXPECT_EQ(read_png(scratch / "real.png").width, 32);
}

TEST(ExitCodes, memory_over_the_budget_ends_with_74_and_names_the_buffer) {
    const ScratchFolder scratch;
    const Words words = {"render", scene_file("one_voxel"), "--size", "640x360", "--memory-budget", "1", "-o",
                         "a.png"};
    const Ending ending = run(words, {.folder = scratch.path()});
    EXPECT_EQ(ending.code, 74);
    EXPECT_NE(ending.err.find("over the budget of 1 MiB; the largest buffer is 'path.starts'"),
              std::string::npos)
        << ending.err;
    EXPECT_EQ(names_in(scratch.path()), Words{});
}

class Interruption : public testing::TestWithParam<int> {};

TEST_P(Interruption, leaves_a_whole_picture_and_no_temporary_files) {
    const ScratchFolder scratch;
    write_text(scratch / "a.exr", "old");
    ChildProcess child(endless_render("a.exr"), {.folder = scratch.path()});
    ASSERT_NE(child.wait_for_error_line(), "");
    child.send(GetParam());
    const Ending ending = child.finish();
    EXPECT_EQ(ending.code, 130) << ending.err;
    EXPECT_NE(ending.out.find("interrupted"), std::string::npos) << ending.out;
    const Image image = read_exr(scratch / "a.exr");
    EXPECT_EQ(image.width, 32);
    EXPECT_EQ(image.height, 18);
    for (const float samples : image.channels.at("sampleCount.Y").pixels)
        ASSERT_GE(samples, 1.0f);
    EXPECT_EQ(names_in(scratch.path()), (Words{"a.exr", "a.exr.part"})) << "and a checkpoint";
}

INSTANTIATE_TEST_SUITE_P(signals, Interruption, testing::Values(SIGINT, SIGTERM),
                         [](const auto& test) { return test.param == SIGINT ? "SIGINT" : "SIGTERM"; });

TEST(Kill, leaves_the_old_picture_whole) {
    const ScratchFolder scratch;
    write_text(scratch / "a.png", "old");
    ChildProcess child(endless_render("a.png"), {.folder = scratch.path()});
    ASSERT_NE(child.wait_for_error_line(), "");
    child.send(SIGKILL);
    EXPECT_EQ(child.finish().signal, SIGKILL);
    EXPECT_EQ(bytes_of(scratch / "a.png"), "old");
    EXPECT_EQ(names_in(scratch.path()), Words{"a.png"});
}

}  // namespace
}  // namespace voxilux::test
