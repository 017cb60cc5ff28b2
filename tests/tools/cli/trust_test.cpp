// What the environment may do to a render: streams that take nothing, odd names, signals, hostile files. None
// of them costs a finished picture.

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <csignal>

#include "formats/exr.h"
#include "support/test_images.h"
#include "tools/cli/words.h"

namespace voxilux::test {
namespace {

namespace fs = std::filesystem;

Words one_voxel(const std::string& output, const Words& more = {}) {
    return with({"render", scene_file("one_voxel"), "--size", "32x18", "--spp", "2", "-o", output}, more);
}

TEST(FullStreams, messages_that_nobody_can_read_change_no_exit_code) {
    const ScratchFolder scratch;
    const Surroundings deaf{.folder = scratch.path(), .error_file = "/dev/full"};
    EXPECT_EQ(run({"render", "nofile.toml"}, deaf).code, 3);
    EXPECT_EQ(run({"rendr"}, deaf).code, 2);
    EXPECT_EQ(run(one_voxel("a.png", {"--progress", "json"}), deaf).code, 0);
    EXPECT_EQ(names_in(scratch.path()), Words{"a.png"});
}

// Results on a full stream are lost, as the exit code says; the picture is not.
TEST(FullStreams, picture_is_written_whatever_standard_output_is) {
    const ScratchFolder scratch;
    const Ending ending =
        run(one_voxel("a.png", {"-v"}), {.folder = scratch.path(), .output_file = "/dev/full"});
    EXPECT_EQ(ending.code, 73);
    EXPECT_EQ(ending.err, "voxilux: cannot write to standard output\n");
    EXPECT_EQ(names_in(scratch.path()), Words{"a.png"});
}

TEST(OddNames, bytes_that_are_no_utf8_pass_through) {
    const ScratchFolder scratch;
    const Surroundings here{.folder = scratch.path()};
    const std::string name = "K\xf6rper.toml";
    fs::copy_file(scene_file("one_voxel"), scratch / name);
    const Words render = {"render",       name,    "--size", "32x18",    "--spp",  "50",
                          "--checkpoint", "0.001", "-o",     "\xfc.exr", "--json", "r.json"};
    const Ending ending = run(render, here);
    EXPECT_EQ(ending.code, 0) << ending.err;
    EXPECT_EQ(Json::parse(bytes_of(scratch / "r.json")).at("command"), "render");
    const Ending info = run({"info", "\xfc.exr", "--json", "-"}, here);
    EXPECT_EQ(info.code, 0) << info.err;
    EXPECT_TRUE(Json::parse(info.out).is_object());
}

TEST(OddNames, long_ones_work_or_are_refused_before_the_work) {
    const ScratchFolder scratch;
    const Surroundings here{.folder = scratch.path()};
    const std::string longest = std::string(251, 'n') + ".exr";
    const Ending ending = run(one_voxel(longest), here);
    EXPECT_EQ(ending.code, 0) << ending.err;
    EXPECT_EQ(names_in(scratch.path()), Words{longest});
    EXPECT_EQ(run(one_voxel("n" + longest, {"--spp", "1000000"}), here).code, 73);
}

TEST(Outputs, no_command_overwrites_what_it_reads) {
    const ScratchFolder scratch;
    const Surroundings here{.folder = scratch.path()};
    fs::copy_file(scene_file("one_voxel"), scratch / "a.toml");
    ASSERT_EQ(run(one_voxel("ref.png"), here).code, 0);
    ASSERT_EQ(run(one_voxel("part.exr", {"--shard", "1/2"}), here).code, 0);
    const std::string scene = bytes_of(scratch / "a.toml"), picture = bytes_of(scratch / "ref.png"),
                      part = bytes_of(scratch / "part.exr");
    const std::vector<Words> commands = {
        {"render", "a.toml", "-o", "b.png", "--json", "a.toml"},
        {"render", "a.toml", "-o", "b.png", "--json", "b.png"},
        {"plan", "a.toml", "--json", "./a.toml"},
        {"info", "a.toml", "--json", "a.toml"},
        {"compare", "ref.png", "ref.png", "--diff", "ref.png"},
        {"merge", "part.exr", "--partial", "-o", "part.exr"},
    };
    for (const Words& words : commands) {
        const Ending ending = run(words, here);
        EXPECT_EQ(ending.code, 2) << words.front() << ": " << ending.err;
    }
    EXPECT_TRUE(bytes_of(scratch / "a.toml") == scene && bytes_of(scratch / "ref.png") == picture &&
                bytes_of(scratch / "part.exr") == part);
    EXPECT_EQ(names_in(scratch.path()), (Words{"a.toml", "part.exr", "ref.png"}));
}

std::string repeated(const std::string& text, int times) {
    std::string all;
    for (int i = 0; i < times; ++i)
        all += text;
    return all;
}

TEST(Ranges, numbers_below_zero_are_refused) {
    EXPECT_EQ(run({"plan", scene_file("one_voxel"), "--memory-budget", "-1"}).code, 2);
    EXPECT_EQ(run({"plan", scene_file("one_voxel"), "--memory-budget", "0"}).code, 0);
}

TEST(Nesting, of_any_depth_is_refused_in_one_line) {
    const ScratchFolder scratch;
    const Surroundings here{.folder = scratch.path()};
    const std::string key = repeated("a.", 40000) + "a";
    const std::map<std::string, std::string> scenes = {
        {"key.toml", key + " = 1\n"},
        {"section.toml", "[" + key + "]\n"},
        {"tables.toml", "a = " + repeated("{a=", 40000) + "1" + repeated("}", 40000) + "\n"},
        {"lists.toml", "a = " + repeated("[", 40000) + repeated("]", 40000) + "\n"}};
    for (const auto& [name, text] : scenes) {
        write_text(scratch / name, text);
        const Ending ending = run({"plan", name}, here);
        EXPECT_EQ(ending.code, 3) << name << ": " << ending.err << ", signal " << ending.signal;
        EXPECT_EQ(ending.err, "voxilux: " + name + ": nested deeper than 32 levels\n");
    }
    EXPECT_EQ(run({"plan", scene_file("one_voxel"), "-D", key + "=1"}, here).code, 3);
    EXPECT_EQ(run({"plan", scene_file("one_voxel"), "-D", "sun.elevation=10"}, here).code, 0);
}

TEST(Nesting, of_json_in_a_picture_is_shown_as_text) {
    const ScratchFolder scratch;
    Image image = make_image(2, 2, Words{"R", "G", "B"});
    image.attributes["deep"] = repeated("{\"a\":", 100000) + "1" + repeated("}", 100000);
    write_exr(scratch / "a.exr", image);
    const Ending ending = run({"info", scratch / "a.exr", "--json", "-"});
    ASSERT_EQ(ending.code, 0) << ending.err << ", signal " << ending.signal;
    EXPECT_TRUE(Json::parse(ending.out).at("attributes").at("deep").is_string());
}

// A render that no machine finishes.
Words endless(const Words& more = {}) {
    return with({"render", scene_file("one_voxel"), "--size", "32x18", "--spp", "100000000", "-o", "a.exr",
                 "--progress", "json"},
                more);
}

TEST(Signals, hang_up_keeps_what_is_done_and_is_acknowledged) {
    const ScratchFolder scratch;
    ChildProcess child(endless(), {.folder = scratch.path()});
    ASSERT_TRUE(child.wait_for_error("\"sample\""));
    child.send(SIGHUP);
    const Ending ending = child.finish();
    EXPECT_EQ(ending.code, 130) << ending.signal;
    EXPECT_NE(ending.err.find("voxilux: stopping in order"), std::string::npos) << ending.err;
    EXPECT_EQ(names_in(scratch.path()), (Words{"a.exr", "a.exr.part"}));
}

TEST(Signals, user_signal_saves_a_checkpoint_and_goes_on) {
    const ScratchFolder scratch;
    ChildProcess child(endless({"--checkpoint", "1000"}), {.folder = scratch.path()});
    ASSERT_TRUE(child.wait_for_error("\"sample\""));
    EXPECT_EQ(names_in(scratch.path()), Words{});
    child.send(SIGUSR1);
    for (int tenths = 0; tenths < 300 && !fs::exists(scratch / "a.exr.part"); ++tenths)
        ::usleep(100000);
    EXPECT_EQ(names_in(scratch.path()), Words{"a.exr.part"});
    child.send(SIGTERM);
    EXPECT_EQ(child.finish().code, 130) << "it was still at work";
}

// The memory that the end of the render needs is reserved before its first sample.
TEST(HostMemory, that_a_picture_will_lack_is_said_before_the_work) {
    const ScratchFolder scratch;
    Words words = one_voxel("a.png", {"--progress", "json"});
    std::ranges::replace(words, std::string("32x18"), std::string("8192x8192"));
    const Ending ending = run(words, {.folder = scratch.path(), .address_space = std::uint64_t{4} << 30});
    EXPECT_EQ(ending.code, 74) << ending.err;
    EXPECT_NE(ending.err.find("ulimit -v"), std::string::npos) << ending.err;
    EXPECT_EQ(ending.err.find("\"sample\""), std::string::npos) << ending.err;
    EXPECT_EQ(names_in(scratch.path()), Words{});
    const Ending small = run(one_voxel("a.png", {"--progress", "json"}),
                             {.folder = scratch.path(), .address_space = std::uint64_t{4} << 30});
    EXPECT_EQ(small.code, 0) << small.err;
    EXPECT_NE(small.err.find("\"sample\""), std::string::npos) << "or the search above finds nothing";
}

TEST(Signals, that_were_ignored_before_stay_ignored) {
    const ScratchFolder scratch;
    ChildProcess child(endless({"--time-limit", "1s"}),
                       {.folder = scratch.path(), .ignored_signals = {SIGINT, SIGHUP}});
    ASSERT_TRUE(child.wait_for_error("\"sample\""));
    child.send(SIGINT);
    child.send(SIGHUP);
    const Ending ending = child.finish();
    EXPECT_EQ(ending.code, 0) << ending.err;
    EXPECT_EQ(ending.err.find("stopping"), std::string::npos);
}

}  // namespace
}  // namespace voxilux::test
