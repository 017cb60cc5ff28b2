// Turntables, transparent pictures, sprites, and the picture settings of a .vox file, as a user renders them.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/colour.h"
#include "formats/exr.h"
#include "formats/png.h"
#include "support/scratch_folder.h"
#include "tools/cli/child_process.h"
#include "tools/cli/models.h"

namespace voxilux::test {
namespace {

TEST(Turntable, turns_camera_model_or_light) {
    const ScratchFolder scratch;
    write_model(scratch / "a.vox");
    for (const char* what : {"camera", "model", "light"}) {
        const std::string file = std::string(what) + ".png";
        const Ending ending =
            run(with({"render", "a.vox", "--turntable", "4", "--turn", what, "-q", "-o", file}, kSmall),
                {.folder = scratch.path()});
        EXPECT_EQ(ending.code, 0) << ending.err;
    }
    const auto picture = [&](const std::string& name) { return bytes_of(scratch / (name + ".png")); };
    EXPECT_EQ(picture("camera.0001"), picture("model.0001"));
    EXPECT_EQ(picture("camera.0001"), picture("light.0001"));
    EXPECT_NE(picture("camera.0002"), picture("light.0002"));
    EXPECT_NE(picture("light.0001"), picture("light.0002"));
    EXPECT_NE(picture("camera.0002"), picture("model.0002"));
    EXPECT_EQ(names_in(scratch.path()).size(), 13u);
}

// A quarter turn of the model equals the file turned by a quarter.
TEST(Turntable, model_turns_before_a_camera_and_a_sun_that_stay) {
    const ScratchFolder scratch;
    const auto scene = [](const char* rotate) {
        return std::string(
                   "[camera]\npreset = \"front\"\nprojection = \"orthographic\"\npixels_per_voxel = 4\n"
                   "[render]\nsize = [32, 24]\nspp = 32\n[[model]]\nfile = \"a.vox\"\n") +
               rotate;
    };
    write_model(scratch / "a.vox");
    write_text(scratch / "rest.toml", scene(""));
    write_text(scratch / "turned.toml", scene("rotate = [\"z90\"]\n"));
    const Surroundings here{.folder = scratch.path()};
    const Ending turn =
        run({"render", "rest.toml", "--turntable", "4", "--turn", "model", "-q", "-o", "m.exr"}, here);
    EXPECT_EQ(turn.code, 0) << turn.err;
    EXPECT_EQ(run({"render", "turned.toml", "-q", "-o", "t.exr"}, here).code, 0);
    // Relative to the picture of the turned file, summed over the pixels.
    const Image turned = read_exr(scratch / "t.exr");
    const auto apart = [&](const char* file) {
        const Image image = read_exr(scratch / file);
        double sum = 0.0;
        for (std::size_t i = 0; i < pixel_count(image); ++i)
            sum += std::abs(static_cast<double>(image.channels.at("R").pixels[i]) -
                            static_cast<double>(turned.channels.at("R").pixels[i]));
        return sum;
    };
    // The turned voxels are the same set; rays meet them at positions that round differently, which moves
    // some samples over an edge: measured 1/84 of what the nearest other turn differs by.
    for (const char* other : {"m.0001.exr", "m.0003.exr", "m.0004.exr"})
        EXPECT_LT(20.0 * apart("m.0002.exr"), apart(other)) << other;
}

TEST(Transparent, alpha_without_a_number_asks_for_it) {
    const ScratchFolder scratch;
    write_model(scratch / "a.vox");
    const Surroundings here{.folder = scratch.path()};
    EXPECT_EQ(
        run(with({"render", "--alpha", "a.vox", "-q", "-o", "a.png", "-o", "a.exr"}, kSmall), here).code, 0);
    EXPECT_EQ(run(with({"render", "a.vox", "-q", "--alpha", "0.5", "-o", "b.png"}, kSmall), here).code, 0);
    const Image image = read_png(scratch / "a.png");
    ASSERT_TRUE(image.channels.contains("A"));
    EXPECT_EQ(image.channels.at("A").pixels[0], 0.0f);
    EXPECT_EQ(image.channels.at("A").pixels[8 * 24 + 12], 1.0f);
    EXPECT_TRUE(read_exr(scratch / "a.exr").channels.contains("A"));
    EXPECT_FALSE(read_png(scratch / "b.png").channels.contains("A"));
}

TEST(TransparentNightly, background_of_a_flag_a_scene_or_a_file_is_exact) {
    const ScratchFolder scratch;
    write_model(scratch / "a.vox", {{"_type", "_setting"}, {"_bg_a", "1"}});
    const Surroundings here{.folder = scratch.path()};
    const auto corner = [&](const Words& more) {
        EXPECT_EQ(run(with(with({"render", "a.vox", "-q", "-o", "x.png"}, kSmall), more), here).code, 0);
        const Image image = read_png(scratch / "x.png");
        std::vector<int> codes;
        for (const auto& [name, channel] : image.channels)
            codes.push_back(name == "A" ? static_cast<int>(channel.pixels[0]) : srgb_code(channel.pixels[0]));
        return codes;
    };
    EXPECT_EQ(corner({}), (std::vector<int>{0, 0, 0, 0})) << "A B G R: the file is transparent";
    EXPECT_EQ(corner({"--background", "#20a1fe"}), (std::vector<int>{0xfe, 0xa1, 0x20})) << "B G R";
    EXPECT_EQ(corner({"-D", "background.color=#ff0007"}), (std::vector<int>{7, 0, 255}));
    EXPECT_EQ(corner({"-D", "background.shown=sky"}), corner({"--ignore-file-settings"}));
    EXPECT_EQ(corner({"--background", "sky", "-D", "background.color=#ff0007"}),
              corner({"--ignore-file-settings"}));
    EXPECT_EQ(run({"render", "a.vox", "--background", "red"}, here).code, 2);
}

TEST(Sprite, is_as_large_as_the_model) {
    const ScratchFolder scratch;
    write_model(scratch / "a.vox");
    const Surroundings here{.folder = scratch.path()};
    const Ending ending = run({"render", "a.vox", "--camera", "front", "--pixels-per-voxel", "4", "--spp",
                               "2", "-q", "-o", "a.png"},
                              here);
    EXPECT_EQ(ending.code, 0) << ending.err;
    const Image sprite = read_png(scratch / "a.png");
    EXPECT_EQ(sprite.width, 3 * 4);
    EXPECT_EQ(sprite.height, 5 * 4) << "3 voxels wide and 5 high from the front";
    EXPECT_EQ(run({"render", "a.vox", "--pixels-per-voxel", "4", "--projection", "fisheye"}, here).code, 2);
    EXPECT_EQ(run({"render", "a.vox", "--pixels-per-voxel", "0"}, here).code, 2);
}

TEST(Parts, of_a_picture_with_a_background_add_up_to_the_whole) {
    const ScratchFolder scratch;
    write_model(scratch / "a.vox");
    const Surroundings here{.folder = scratch.path()};
    const Words picture =
        with({"render", "a.vox", "-q", "--reproducible", "--background", "#203040"}, kSmall);
    EXPECT_EQ(run(with(picture, {"-o", "whole.exr", "-o", "whole.png"}), here).code, 0);
    for (const char* shard : {"1/2", "2/2"})
        EXPECT_EQ(
            run(with(picture, {"--shard", shard, "-o", std::string("p") + shard[0] + ".exr"}), here).code, 0);
    const Ending merged =
        run({"merge", "p1.exr", "p2.exr", "-q", "--reproducible", "-o", "m.exr", "-o", "m.png"}, here);
    EXPECT_EQ(merged.code, 0) << merged.err;
    EXPECT_EQ(bytes_of(scratch / "m.png"), bytes_of(scratch / "whole.png"));
    for (const char* name : {"R", "G", "B"})
        EXPECT_EQ(read_exr(scratch / "m.exr").channels.at(name).pixels,
                  read_exr(scratch / "whole.exr").channels.at(name).pixels);
}

TEST(Parts, have_the_exposure_of_their_file) {
    const ScratchFolder scratch;
    write_model(scratch / "a.vox", {{"_type", "_film"}, {"_expo", "4"}});
    const Surroundings here{.folder = scratch.path()};
    const Words picture = with({"render", "a.vox", "-q", "--reproducible"}, kSmall);
    EXPECT_EQ(run(with(picture, {"-o", "whole.png"}), here).code, 0);
    EXPECT_EQ(run(with(picture, {"--exposure", "0", "-o", "dark.png"}), here).code, 0);
    EXPECT_EQ(run(with(picture, {"--samples", "0-1", "-o", "p.exr"}), here).code, 0);
    EXPECT_EQ(run({"merge", "p.exr", "-q", "-o", "m.png"}, here).code, 0);
    EXPECT_EQ(run({"merge", "p.exr", "-q", "--exposure", "0", "-o", "d.png"}, here).code, 0);
    EXPECT_EQ(bytes_of(scratch / "m.png"), bytes_of(scratch / "whole.png"));
    EXPECT_EQ(bytes_of(scratch / "d.png"), bytes_of(scratch / "dark.png"));
    EXPECT_NE(bytes_of(scratch / "d.png"), bytes_of(scratch / "m.png"));
}

TEST(Info, lists_settings_and_cameras_of_a_file) {
    const ScratchFolder scratch;
    write_model(scratch / "a.vox", {{"_type", "_fog_uni"}, {"_d", "0.9"}});
    const Json facts = json_of({"info", scratch / "a.vox", "--json", "-"});
    EXPECT_EQ(facts["cameras"], 2);
    ASSERT_EQ(facts["saved_cameras"].size(), 1u);
    EXPECT_EQ(facts["saved_cameras"][0]["name"], "2");
    ASSERT_EQ(facts["settings"].size(), 1u);
    EXPECT_EQ(facts["settings"][0], (Json{{"_type", "_fog_uni"}, {"_d", "0.9"}}));
    ASSERT_EQ(facts["warnings"].size(), 1u) << facts["warnings"];
    EXPECT_EQ(facts["warnings"][0], "fog is not shown");
    const Ending plan = run({"plan", scratch / "a.vox"});
    EXPECT_NE(plan.out.find("fog is not shown"), std::string::npos) << plan.out;
}

}  // namespace
}  // namespace voxilux::test
