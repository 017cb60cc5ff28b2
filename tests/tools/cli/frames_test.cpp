// Frame ranges as a user renders them.

#include <gtest/gtest.h>

#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "formats/exr.h"
#include "support/scratch_folder.h"
#include "tools/cli/child_process.h"
#include "tools/cli/words.h"

namespace voxilux::test {
namespace {

Words small_turn(const Words& more) {
    return with({"render", scene_file("turntable"), "--size", "32x18", "--spp", "2", "-D", "ao.method=brute"},
                more);
}

TEST(Frames, every_frame_has_its_numbered_files) {
    const ScratchFolder scratch;
    const Ending ending =
        run(small_turn({"--frames", "1-5x2", "-o", "a.exr", "-o", "b.c.png"}), {.folder = scratch.path()});
    EXPECT_EQ(ending.code, 0) << ending.err;
    EXPECT_EQ(ending.err, "");
    EXPECT_EQ(names_in(scratch.path()), (Words{"a.0001.exr", "a.0003.exr", "a.0005.exr", "b.c.0001.png",
                                               "b.c.0003.png", "b.c.0005.png"}));
    EXPECT_NE(ending.out.find("a.0003.exr b.c.0003.png\n"), std::string::npos) << ending.out;
}

TEST(Frames, numbers_are_as_wide_as_the_last) {
    const ScratchFolder scratch;
    EXPECT_EQ(
        run(small_turn({"--frames", "9999-10000", "-q", "-o", "a.png"}), {.folder = scratch.path()}).code, 0);
    EXPECT_EQ(names_in(scratch.path()), (Words{"a.09999.png", "a.10000.png"}));
}

TEST(Frames, frame_of_a_range_has_the_bytes_of_the_frame_alone) {
    const ScratchFolder scratch;
    const Surroundings here{.folder = scratch.path()};
    EXPECT_EQ(run(small_turn({"--frames", "6-8", "--reproducible", "-o", "a.exr"}), here).code, 0);
    EXPECT_EQ(run(small_turn({"--frame", "7", "--reproducible", "-o", "one.exr"}), here).code, 0);
    EXPECT_EQ(bytes_of(scratch / "a.0007.exr"), bytes_of(scratch / "one.exr"));
    EXPECT_NE(bytes_of(scratch / "a.0008.exr"), bytes_of(scratch / "one.exr"));
    // 24 frames make a whole turn.
    EXPECT_EQ(run(small_turn({"--frames", "31", "--reproducible", "-o", "a.exr"}), here).code, 0);
    EXPECT_EQ(read_exr(scratch / "a.0031.exr").channels.at("R").pixels,
              read_exr(scratch / "one.exr").channels.at("R").pixels);
}

TEST(Frames, report_has_totals_and_a_row_for_each) {
    const ScratchFolder scratch;
    const Ending ending =
        run(small_turn({"--frames", "2-3", "--json", "-", "-o", "a.png"}), {.folder = scratch.path()});
    const Json report = Json::parse(ending.out);
    const Json alone = Json::parse(
        run(small_turn({"--frame", "2", "--json", "-", "-o", "one.png"}), {.folder = scratch.path()}).out);
    auto keys = keys_of(alone);
    EXPECT_FALSE(keys.contains("frames"));
    keys.insert("frames");
    EXPECT_EQ(keys_of(report), keys);
    EXPECT_NE(report["scene_hash"], alone["scene_hash"]) << "of the animation, not of a frame";
    ASSERT_EQ(report["frames"].size(), 2u);
    EXPECT_EQ(report["frames"][1]["frame"], 3);
    EXPECT_EQ(report["frames"][1]["files"], Json({"a.0003.png"}));
    EXPECT_EQ(report["frames"][0]["work"], alone["work"]);
    for (const Json& row : report["frames"]) {
        EXPECT_EQ(keys_of(row), (std::set<std::string>{"frame", "files", "samples", "stopped", "wall_s",
                                                       "gpu_ms", "passes", "work", "error", "faults"}));
        EXPECT_LE(row["wall_s"], report["wall_s"]);
        EXPECT_LE(row["error"]["high"], report["error"]["high"]);
        for (const auto& [name, count] : row["faults"].items())
            EXPECT_EQ(count, 0) << name;
    }
    const auto sum = [&](const char* table, const char* name) {
        return report["frames"][0][table][name].get<int>() + report["frames"][1][table][name].get<int>();
    };
    EXPECT_EQ(report["work"]["primary_rays"], 2 * 32 * 18 * 2);
    EXPECT_EQ(report["work"]["ao_rays"], sum("work", "ao_rays"));
    EXPECT_NEAR(report["gpu_ms"],
                report["frames"][0]["gpu_ms"].get<double>() + report["frames"][1]["gpu_ms"].get<double>(),
                1e-6);
}

TEST(Frames, progress_is_that_of_the_whole_range) {
    const ScratchFolder scratch;
    const Ending ending = run(small_turn({"--frames", "1-3", "--progress", "json", "-o", scratch / "a.png"}));
    std::istringstream lines(ending.err);
    double last = 0.0;
    std::uint32_t frame = 1;
    for (std::string line; std::getline(lines, line);) {
        const Json progress = Json::parse(line);
        EXPECT_EQ(progress["frames"], 3);
        EXPECT_GE(progress["frame"], frame);
        EXPECT_GE(progress["done"], last);
        last = progress["done"];
        frame = progress["frame"];
    }
    EXPECT_EQ(frame, 3u);
    EXPECT_EQ(last, 1.0);
}

TEST(Frames, time_limit_is_shared_and_every_frame_is_whole) {
    const ScratchFolder scratch;
    const Ending ending = run(small_turn({"--frames", "1-3", "--spp", "100000000", "--time-limit", "1.5s",
                                          "--json", "-", "-o", scratch / "a.exr"}));
    EXPECT_EQ(ending.code, 0) << ending.err;
    const Json report = Json::parse(ending.out);
    ASSERT_EQ(report["frames"].size(), 3u);
    for (const Json& row : report["frames"]) {
        EXPECT_EQ(row["stopped"], "time limit reached");
        EXPECT_GE(row["samples"], 1);
    }
    const Image last = read_exr(scratch / "a.0003.exr");
    for (const float samples : last.channels.at("sampleCount.Y").pixels)
        ASSERT_GE(samples, 1.0f);
}

TEST(Frames, error_missed_in_time_ends_with_4) {
    const ScratchFolder scratch;
    const Ending ending = run({"render", scene_file("turntable"), "--size", "32x18", "--frames", "1-2",
                               "--error", "0.0001%", "--time-limit", "3s", "-o", scratch / "a.png"});
    EXPECT_EQ(ending.code, 4) << ending.err;
    EXPECT_NE(ending.err.find("2 of 2 frames stopped with an error over the 0.0001% asked for"),
              std::string::npos)
        << ending.err;
}

// One sample of a frame takes longer than all frames may.
TEST(Frames, that_have_no_time_are_not_begun_and_named) {
    const ScratchFolder scratch;
    const Ending ending =
        run({"render", scene_file("turntable"), "--size", "640x360", "--ao", "brute", "--ao-rays", "64",
             "--frames", "1-9", "--time-limit", "0.2s", "-q", "-o", "a.png"},
            {.folder = scratch.path()});
    EXPECT_EQ(ending.code, 4) << ending.err;
    EXPECT_EQ(names_in(scratch.path()), Words{"a.0001.png"});
    EXPECT_EQ(ending.err,
              "voxilux: no time left for frame 2; 1 of 9 frames are written; go on with --frames 2-9\n");
}

// The first frame takes its part of the time; the signal comes in the second frame.
TEST(Frames, interruption_keeps_what_is_finished_and_says_how_to_go_on) {
    const ScratchFolder scratch;
    ChildProcess child(small_turn({"--frames", "3-9x2", "--spp", "100000000", "--time-limit", "8s",
                                   "--progress", "json", "-o", "a.exr"}),
                       {.folder = scratch.path()});
    ASSERT_TRUE(child.wait_for_error("\"frame\":2"));
    child.send(SIGINT);
    const Ending ending = child.finish();
    EXPECT_EQ(ending.code, 130) << ending.err;
    EXPECT_EQ(names_in(scratch.path()), Words{"a.0003.exr"});
    EXPECT_NE(
        ending.err.find("interrupted in frame 5; 1 of 4 frames are written; go on with --frames 5-9x2\n"),
        std::string::npos)
        << ending.err.substr(ending.err.size() > 400 ? ending.err.size() - 400 : 0);
    EXPECT_EQ(read_exr(scratch / "a.0003.exr").width, 32);
}

TEST(Frames, frame_that_cannot_be_rendered_is_named_and_earlier_ones_stay) {
    const ScratchFolder scratch;
    std::ofstream(scratch / "s.toml")
        << "[render]\nsize = [16, 9]\nspp = 1\n"
           "[[camera.key]]\nframe = 1\nposition = [0, 0, 5]\nyaw = 0\npitch = 0\n"
           "[[camera.key]]\nframe = 3\nposition = [1e8, 0, 5]\nyaw = 0\npitch = 0\n"
           "[material.m]\n[[shape]]\nshape = 'box'\nmaterial = 'm'\n"
           "from = [4, 0, 0]\nto = [8, 4, 4]\n";
    const Ending ending =
        run({"render", scratch / "s.toml", "--frames", "1-3", "-q", "-o", scratch / "a.png"});
    EXPECT_EQ(ending.code, 3);
    EXPECT_TRUE(ending.err.starts_with("voxilux: frame 2: camera position (50000000, 0, 5) is over"))
        << ending.err;
    EXPECT_TRUE(ending.err.ends_with("; 1 of 3 frames are written\n")) << ending.err;
    EXPECT_EQ(names_in(scratch.path()), (Words{"a.0001.png", "s.toml"}));
}

TEST(Frames, picture_of_an_animation_is_noted_to_be_one_of_many) {
    const ScratchFolder scratch;
    const std::string note = "note: this is frame 1 of an animation; --frames 1-24 renders all 24\n";
    EXPECT_EQ(run(small_turn({"-o", scratch / "a.png"})).err, note);
    EXPECT_EQ(run(small_turn({"-o", scratch / "a.png", "-q"})).err, "");
    EXPECT_EQ(run(small_turn({"-o", scratch / "a.png", "--frame", "1"})).err, "");
    EXPECT_EQ(run({"plan", scene_file("turntable")}).err, note);
    EXPECT_EQ(names_in(scratch.path()), Words{"a.png"});
}

TEST(Frames, plan_counts_them) {
    const Ending text = run({"plan", scene_file("turntable"), "--frames", "2-24x2"});
    EXPECT_EQ(text.err, "");
    EXPECT_NE(text.out.find("\nframes    12, this is the plan of frame 2\n"), std::string::npos) << text.out;
    const Json json =
        Json::parse(run({"plan", scene_file("turntable"), "--frames", "2-24x2", "--json", "-"}).out);
    EXPECT_EQ(json["frames"], (Json{{"count", 12}, {"first", 2}, {"last", 24}, {"step", 2}}));
}

TEST(Frames, unnamed_pictures_never_replace_files) {
    const ScratchFolder scratch;
    const Surroundings here{.folder = scratch.path()};
    EXPECT_EQ(run(small_turn({"--frames", "2", "-q"}), here).code, 0);
    const Ending ending = run(small_turn({"--frames", "1-2"}), here);
    EXPECT_EQ(ending.code, 2);
    EXPECT_NE(ending.err.find("turntable.0002.png is there already"), std::string::npos) << ending.err;
    const Ending turn = run(small_turn({"--turntable", "2"}), here);
    EXPECT_EQ(turn.code, 2);
    EXPECT_NE(turn.err.find("turntable.0002.png is there already"), std::string::npos) << turn.err;
    EXPECT_EQ(names_in(scratch.path()), Words{"turntable.0002.png"});
}

TEST(Frames, side_named_by_a_flag_is_where_the_turn_begins) {
    const ScratchFolder scratch;
    const Surroundings here{.folder = scratch.path()};
    // The turn begins at the front; after a quarter the right side is seen.
    EXPECT_EQ(run(small_turn({"--camera", "front", "--frame", "7", "-q", "-o", "a.exr"}), here).code, 0);
    EXPECT_EQ(run(small_turn({"--camera", "right", "--frame", "1", "-q", "-o", "b.exr"}), here).code, 0);
    EXPECT_EQ(read_exr(scratch / "a.exr").channels.at("Z").pixels,
              read_exr(scratch / "b.exr").channels.at("Z").pixels);
}

}  // namespace
}  // namespace voxilux::test
