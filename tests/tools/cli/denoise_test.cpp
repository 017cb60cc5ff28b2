// Denoising as a user asks for it.

#include <gtest/gtest.h>

#include <csignal>
#include <nlohmann/json.hpp>

#include "formats/exr.h"
#include "support/scratch_folder.h"
#include "tools/cli/child_process.h"
#include "tools/cli/models.h"
#include "tools/cli/words.h"

namespace voxilux::test {
namespace {

Words dim_court(const Words& more) {
    return with({"render", scene_file("mixed"), "--size", "48x27", "--denoise", "on"}, more);
}

nlohmann::json report_of(const ScratchFolder& scratch, const std::string& file) {
    return nlohmann::json::parse(bytes_of(scratch / file));
}

TEST(DenoiseCommand, render_writes_both_pictures_and_the_claim) {
    const ScratchFolder scratch;
    const Surroundings here{.folder = scratch.path()};
    const Ending ending =
        run(dim_court({"--spp", "6", "-o", "a.exr", "-o", "a.png", "--json", "a.json"}), here);
    ASSERT_EQ(ending.code, 0) << ending.err;
    EXPECT_NE(ending.out.find("denoised  "), std::string::npos) << ending.out;
    const nlohmann::json claim = report_of(scratch, "a.json").at("denoised");
    EXPECT_TRUE(claim.at("filtered").get<bool>());
    EXPECT_LE(claim.at("error").at("low"), claim.at("error").at("estimate"));
    EXPECT_LE(claim.at("error").at("estimate"), claim.at("error").at("high"));
    EXPECT_LT(claim.at("error").at("estimate"), report_of(scratch, "a.json").at("error").at("estimate"));
    const Image both = read_exr(scratch / "a.exr");
    EXPECT_NE(both.channels.at("denoised.G").pixels, both.channels.at("G").pixels);
    EXPECT_TRUE(both.channels.contains("denoised.error.Y"));

    const Words plain = {"render", scene_file("mixed"), "--size", "48x27", "--spp", "6", "-q"};
    EXPECT_EQ(run(with(plain, {"-o", "p.exr", "-o", "p.png"}), here).code, 0);
    EXPECT_EQ(read_exr(scratch / "p.exr").channels.at("G").pixels, both.channels.at("G").pixels);
    EXPECT_NE(bytes_of(scratch / "p.png"), bytes_of(scratch / "a.png"));
    EXPECT_FALSE(read_exr(scratch / "p.exr").channels.contains("denoised.G"));
}

// The target is one of the picture that is shown, so it takes fewer samples than the plain one would.
TEST(DenoiseCommand, error_target_is_that_of_the_denoised_picture) {
    const ScratchFolder scratch;
    const Surroundings here{.folder = scratch.path()};
    const Words target = {"render", scene_file("wall_corner"), "--size", "48x27", "--error", "2%", "-q"};
    ASSERT_EQ(run(with(target, {"--denoise", "on", "-o", "d.exr", "--json", "d.json"}), here).code, 0);
    ASSERT_EQ(run(with(target, {"-o", "p.exr", "--json", "p.json"}), here).code, 0);
    const nlohmann::json denoised = report_of(scratch, "d.json"), plain = report_of(scratch, "p.json");
    EXPECT_EQ(denoised.at("stopped"), plain.at("stopped"));
    EXPECT_LE(denoised.at("denoised").at("error").at("high"), 0.02);
    EXPECT_GT(denoised.at("error").at("high"), 0.02);
    EXPECT_LT(denoised.at("samples"), plain.at("samples"));
    EXPECT_TRUE(denoised.at("next_minute").is_null()) << "how fast that error falls is unknown";
}

TEST(DenoiseCommand, error_that_is_missed_is_said) {
    const ScratchFolder scratch;
    const Words few = dim_court({"--spp", "8", "--error", "0.1%", "-o", "a.exr"});
    const Ending ending = run(few, {.folder = scratch.path()});
    EXPECT_NE(ending.err.find("over the 0.1% asked for"), std::string::npos) << ending.err;
}

TEST(DenoiseCommand, parts_are_filtered_when_they_are_together) {
    const ScratchFolder scratch;
    const Surroundings here{.folder = scratch.path()};
    const Words quiet = {"-q", "--reproducible", "--spp", "6"};
    ASSERT_EQ(run(with(dim_court(quiet), {"-o", "whole.png"}), here).code, 0);
    for (const std::string half : {"1", "2"})
        ASSERT_EQ(run(with(dim_court(quiet), {"--shard", half + "/2", "-o", half + ".exr"}), here).code, 0);
    ASSERT_EQ(run({"merge", "1.exr", "2.exr", "--partial", "-q", "-o", "sums.exr"}, here).code, 0);
    const Ending ending = run({"denoise", "sums.exr", "-o", "d.png", "-o", "d.exr", "--json", "-"}, here);
    ASSERT_EQ(ending.code, 0) << ending.err;
    EXPECT_TRUE(nlohmann::json::parse(ending.out).at("denoised").at("filtered").get<bool>());
    EXPECT_TRUE(bytes_of(scratch / "d.png") == bytes_of(scratch / "whole.png"));
    EXPECT_TRUE(read_exr(scratch / "d.exr").channels.contains("denoised.error.Y"));
    // One half of the samples fills only one half of the film.
    EXPECT_EQ(run({"denoise", "1.exr", "-o", "one.png", "-q"}, here).code, 0);
    EXPECT_FALSE(bytes_of(scratch / "one.png") == bytes_of(scratch / "d.png"));
}

// A part carries the exposure that its file's author has set.
TEST(DenoiseCommand, part_is_shown_with_the_exposure_of_its_file) {
    const ScratchFolder scratch;
    const Surroundings here{.folder = scratch.path()};
    write_model(scratch / "m.vox", {{"_type", "_film"}, {"_expo", "4"}});
    const Words small = {"render", "m.vox", "--size", "48x27", "--denoise", "on", "-q", "--reproducible"};
    ASSERT_EQ(run(with(small, {"--spp", "6", "-o", "whole.png"}), here).code, 0);
    ASSERT_EQ(run(with(small, {"--samples", "0-5", "-o", "part.exr"}), here).code, 0);
    ASSERT_EQ(run({"denoise", "part.exr", "-o", "d.png", "-q"}, here).code, 0);
    EXPECT_TRUE(bytes_of(scratch / "d.png") == bytes_of(scratch / "whole.png"));
}

TEST(DenoiseCommand, background_lies_behind_both_pictures) {
    const ScratchFolder scratch;
    const Ending ending =
        run(dim_court({"--spp", "6", "--background", "#00ff00", "-o", "a.exr"}), {.folder = scratch.path()});
    ASSERT_EQ(ending.code, 0) << ending.err;
    const Image both = read_exr(scratch / "a.exr");
    EXPECT_EQ(both.channels.at("G").pixels.front(), 1.0f) << "no surface in the first pixel";
    EXPECT_EQ(both.channels.at("denoised.G").pixels.front(), 1.0f);
}

// SIGUSR1 asks for a checkpoint, which a PNG does not have.
TEST(DenoiseCommandNightly, signal_for_a_checkpoint_stops_nothing) {
    const ScratchFolder scratch;
    ChildProcess child(dim_court({"--spp", "1000000", "--progress", "json", "-o", "a.png"}),
                       {.folder = scratch.path()});
    ASSERT_TRUE(child.wait_for_error("\"sample\":3"));
    child.send(SIGUSR1);
    ASSERT_TRUE(child.wait_for_error("\"sample\":30"));
    child.send(SIGINT);
    const Ending ending = child.finish();
    EXPECT_EQ(ending.code, 130) << ending.err;
    EXPECT_EQ(names_in(scratch.path()), Words{"a.png"});
}

TEST(DenoiseCommand, refuses_what_it_cannot_filter_and_keeps_what_it_should_not) {
    const ScratchFolder scratch;
    const Surroundings here{.folder = scratch.path()};
    const Words one_voxel = {"render", scene_file("one_voxel"), "--size", "32x18", "-q"};
    ASSERT_EQ(run(with(one_voxel, {"--samples", "0-3", "-o", "part.exr"}), here).code, 0);
    Ending ending = run({"denoise", "part.exr", "-o", "d.png"}, here);
    EXPECT_EQ(ending.code, 3);
    EXPECT_NE(ending.err.find("without --denoise on"), std::string::npos) << ending.err;
    EXPECT_EQ(run({"denoise", "part.exr", "-o", "part.exr"}, here).code, 2) << "an output that is the input";
    EXPECT_EQ(run(with(one_voxel, {"--denoise", "perhaps", "-o", "x.png"}), here).code, 2);
    EXPECT_EQ(names_in(scratch.path()), Words{"part.exr"});

    ending = run(with(one_voxel, {"--denoise", "on", "--spp", "1", "-o", "one.png", "--json", "-"}), here);
    EXPECT_EQ(ending.code, 0);
    const nlohmann::json claim = nlohmann::json::parse(ending.out).at("denoised");
    EXPECT_FALSE(claim.at("filtered").get<bool>());
    EXPECT_NE(claim.at("reason").get<std::string>().find("even"), std::string::npos);
    EXPECT_EQ(run(with(one_voxel, {"--spp", "1", "-o", "plain.png"}), here).code, 0);
    EXPECT_TRUE(bytes_of(scratch / "one.png") == bytes_of(scratch / "plain.png"));
}

}  // namespace
}  // namespace voxilux::test
