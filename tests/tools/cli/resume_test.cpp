// Checkpoints: what an unfinished render leaves, and how it goes on.

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <nlohmann/json.hpp>
#include <random>

#include "base/file.h"
#include "formats/exr.h"
#include "support/scratch_folder.h"
#include "tools/cli/child_process.h"
#include "tools/cli/words.h"

namespace voxilux::test {
namespace {

namespace fs = std::filesystem;

Words reproducible_mixed(const Words& more) {
    return with({"render", scene_file("mixed"), "--size", "64x36", "--reproducible", "-o", "a.exr"}, more);
}

// The bytes of the picture of an uninterrupted render.
std::string uninterrupted(const Words& more) {
    const ScratchFolder scratch;
    Words words = reproducible_mixed(more);
    words.push_back("-q");
    EXPECT_EQ(run(words, {.folder = scratch.path()}).code, 0);
    EXPECT_EQ(names_in(scratch.path()), Words{"a.exr"});
    return bytes_of(scratch / "a.exr");
}

// Names in the folder, without files that were being written when their process was killed.
Words whole_names_in(const fs::path& folder) {
    Words names = names_in(folder);
    std::erase_if(names, [](const std::string& name) { return name.ends_with(".tmp"); });
    return names;
}

// Kills a render again and again at random moments after its first checkpoints, each time going on from what
// the last one left, then lets it end.
TEST(Resume, killed_render_ends_with_the_bytes_of_the_uninterrupted_one) {
    const Words settings = {"--spp", "200", "--checkpoint", "0.01"};
    const std::string expected = uninterrupted(settings);
    const ScratchFolder scratch;
    std::mt19937 random(1);
    std::uniform_int_distribution<useconds_t> pause_us(0, 100000);
    int killed = 0;
    for (int round = 0; round < 6; ++round) {
        Words words = reproducible_mixed(settings);
        words.insert(words.end(), {"--resume", "--progress", "json"});
        ChildProcess child(words, {.folder = scratch.path()});
        (void)child.wait_for_error("\"sample\"");
        ::usleep(pause_us(random));
        child.send(SIGKILL);
        if (child.finish().signal == SIGKILL) ++killed;
        if (fs::exists(scratch / "a.exr")) break;
        for (const std::string& name : whole_names_in(scratch.path()))
            EXPECT_EQ(read_exr(scratch / name).width, 64) << "a checkpoint is whole, and a picture";
    }
    EXPECT_GE(killed, 3);
    Words words = reproducible_mixed(settings);
    words.push_back("--resume");
    const Ending ending = run(words, {.folder = scratch.path()});
    EXPECT_EQ(ending.code, 0) << ending.err;
    EXPECT_TRUE(bytes_of(scratch / "a.exr") == expected);
    EXPECT_EQ(whole_names_in(scratch.path()), Words{"a.exr"})
        << "the checkpoint goes when the picture is there";
}

TEST(Resume, render_out_of_time_goes_on_to_more_samples_than_it_was_started_for) {
    const ScratchFolder scratch;
    const Surroundings here{.folder = scratch.path()};
    EXPECT_EQ(run(reproducible_mixed({"--spp", "100000", "--time-limit", "0.3s", "-q"}), here).code, 0);
    EXPECT_EQ(names_in(scratch.path()), (Words{"a.exr", "a.exr.part"}));
    const Image first = read_exr(scratch / "a.exr");
    const auto samples = static_cast<int>(first.channels.at("sampleCount.Y").pixels.back());
    ASSERT_GE(samples, 1);
    const std::string spp = std::to_string(samples + 3);
    const Ending ending = run(reproducible_mixed({"--spp", spp, "--resume"}), here);
    EXPECT_EQ(ending.code, 0) << ending.err;
    EXPECT_EQ(ending.err, "note: going on from " + std::to_string(samples) + " samples of a.exr.part\n");
    EXPECT_TRUE(bytes_of(scratch / "a.exr") == uninterrupted({"--spp", spp}));
    EXPECT_FALSE(bytes_of(scratch / "a.exr") == uninterrupted({"--spp", std::to_string(samples + 4)}));
}

// So many rays for each pixel that the first tile is one row and the second four: the signal comes within
// the first sample.
TEST(ResumeNightly, interruption_within_a_sample_goes_on_at_its_row) {
    const ScratchFolder scratch;
    const Words job = {
        "render", scene_file("mixed"), "--size", "64x64", "--spp", "3", "--ao-rays", "65535", "--ao",
        "brute",  "--reproducible",    "-o",     "a.exr"};
    const auto with = [&](const Words& more) {
        Words words = job;
        words.insert(words.end(), more.begin(), more.end());
        return words;
    };
    ChildProcess child(with({"--progress", "json"}), {.folder = scratch.path()});
    ASSERT_NE(child.wait_for_error_line(), "");
    child.send(SIGINT);
    EXPECT_EQ(child.finish().code, 130);
    const Image part = decode_exr(read_file(scratch / "a.exr.part"), "a.exr.part");
    const Json description = Json::parse(part.attributes.at("voxilux.part"));
    const std::vector<float>& samples = part.channels.at("sampleCount.Y").pixels;
    const float whole = samples.back();  // as many as the machine took before it was told to stop
    ASSERT_LT(whole, 3.0f);
    EXPECT_EQ(description["samples"], (Words{"", "0", "0-1"})[static_cast<std::size_t>(whole)]);
    EXPECT_GT(description["ahead"]["rows"], 0) << "or this tests nothing";
    EXPECT_EQ(description["ahead"]["sample"], whole);
    EXPECT_EQ(samples.front(), whole + 1.0f);
    const Ending merged =
        run({"merge", "a.exr.part", "--partial", "-o", "m.exr"}, {.folder = scratch.path()});
    EXPECT_EQ(merged.code, 3);
    EXPECT_NE(merged.err.find("it ends within a sample"), std::string::npos) << merged.err;

    EXPECT_EQ(run(with({"--resume", "-q"}), {.folder = scratch.path()}).code, 0);
    const std::string resumed = bytes_of(scratch / "a.exr");
    EXPECT_EQ(run(with({"-q"}), {.folder = scratch.path()}).code, 0);
    EXPECT_TRUE(resumed == bytes_of(scratch / "a.exr"));
}

TEST(Resume, interrupted_shard_goes_on_and_merges) {
    const ScratchFolder scratch;
    const Surroundings here{.folder = scratch.path()};
    const Words first = {"--spp", "100", "--shard", "1/2", "-q"};
    const auto with = [](Words words, const Words& more) {
        words.insert(words.end(), more.begin(), more.end());
        return words;
    };
    EXPECT_EQ(run(reproducible_mixed(with(first, {"--time-limit", "0.2s"})), here).code, 0);
    const Ending early = run({"merge", "a.exr", "--partial", "-q", "-o", "early.png"}, here);
    EXPECT_TRUE(early.code == 0 || early.err.find("it ends within a sample") != std::string::npos)
        << early.err;
    EXPECT_EQ(run(reproducible_mixed(with(first, {"--resume"})), here).code, 0);
    fs::rename(scratch / "a.exr", scratch / "b.exr");
    EXPECT_EQ(run(reproducible_mixed({"--spp", "100", "--shard", "2/2", "-q"}), here).code, 0);
    const Ending merged = run({"merge", "b.exr", "a.exr", "--reproducible", "-q", "-o", "m.exr"}, here);
    EXPECT_EQ(merged.code, 0) << merged.err;
    EXPECT_TRUE(bytes_of(scratch / "m.exr") == uninterrupted({"--spp", "100"}));
}

TEST(ResumeNightly, checkpoint_of_other_settings_is_refused_and_stays) {
    const ScratchFolder scratch;
    const Surroundings here{.folder = scratch.path()};
    EXPECT_EQ(run(reproducible_mixed({"--spp", "100000", "--time-limit", "6s", "-q"}), here).code, 0);
    const float samples = read_exr(scratch / "a.exr").channels.at("sampleCount.Y").pixels.back();
    ASSERT_GE(samples, 2.0f);
    const std::string before = bytes_of(scratch / "a.exr.part");
    const auto refusal = [&](const Words& more) {
        Words words = reproducible_mixed({"--resume", "--spp", "100000"});
        words.insert(words.end(), more.begin(), more.end());
        const Ending ending = run(words, here);
        EXPECT_EQ(ending.code, 3) << ending.err;
        return ending.err;
    };
    EXPECT_EQ(refusal({"--seed", "9"}),
              "voxilux: a.exr.part: cannot go on from it: its seed is 0 and not 9; without --resume the "
              "render starts "
              "anew\n");
    EXPECT_NE(refusal({"-D", "sun.elevation=11"}).find("its scene_hash is"), std::string::npos);
    EXPECT_NE(refusal({"--shard", "1/2"}).find("it has other samples than this render begins with, 0"),
              std::string::npos);
    EXPECT_NE(refusal({"--spp", "1"}).find("it has more than 1 samples already"), std::string::npos);
    EXPECT_TRUE(bytes_of(scratch / "a.exr.part") == before);
}

TEST(Resume, without_a_checkpoint_the_render_starts_anew_and_says_so) {
    const ScratchFolder scratch;
    const Ending ending = run(reproducible_mixed({"--spp", "2", "--resume"}), {.folder = scratch.path()});
    EXPECT_EQ(ending.code, 0);
    EXPECT_EQ(ending.err, "note: there is no a.exr.part: the render starts anew\n");
    EXPECT_EQ(names_in(scratch.path()), Words{"a.exr"});
}

TEST(Checkpoint, interval_of_0_leaves_none) {
    const ScratchFolder scratch;
    const Surroundings here{.folder = scratch.path()};
    EXPECT_EQ(
        run(reproducible_mixed({"--spp", "100000", "--time-limit", "0.2s", "-q", "--checkpoint", "0"}), here)
            .code,
        0);
    EXPECT_EQ(names_in(scratch.path()), Words{"a.exr"});
}

TEST(Checkpoint, interruption_leaves_one_beside_the_picture) {
    const ScratchFolder scratch;
    Words words = reproducible_mixed({"--spp", "100000000", "--progress", "json"});
    ChildProcess child(words, {.folder = scratch.path()});
    ASSERT_TRUE(child.wait_for_error("\"sample\":3"));
    child.send(SIGINT);
    EXPECT_EQ(child.finish().code, 130);
    EXPECT_EQ(names_in(scratch.path()), (Words{"a.exr", "a.exr.part"}));
}

TEST(Checkpoint, forgotten_one_is_noted) {
    const ScratchFolder scratch;
    const Surroundings here{.folder = scratch.path()};
    EXPECT_EQ(run(reproducible_mixed({"--spp", "100000", "--time-limit", "0.2s", "-q"}), here).code, 0);
    EXPECT_EQ(run(reproducible_mixed({"--spp", "2"}), here).err,
              "note: there is a checkpoint, a.exr.part; --resume goes on from it\n");
}

}  // namespace
}  // namespace voxilux::test
