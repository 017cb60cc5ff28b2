#include <ImfInputFile.h>
#include <ImfStandardAttributes.h>
#include <gtest/gtest.h>

#include <chrono>
#include <set>

#include "film/tonemap.h"
#include "formats/exr.h"
#include "formats/png.h"
#include "support/scratch_folder.h"
#include "tools/cli/child_process.h"
#include "tools/cli/words.h"

namespace voxilux::test {
namespace {

// A render of voxels and spheres in which every effect but emission runs.
Words small_mixed(Words more) {
    return with({"render", scene_file("mixed"), "--size", "48x27", "--spp", "4", "-q"}, more);
}

struct Pictures {
    std::string exr;
    std::string png;
    bool operator==(const Pictures&) const = default;
};

// The bytes of both pictures of a render.
Pictures render(Words more, std::map<std::string, std::string> environment = {}) {
    const ScratchFolder scratch;
    more.insert(more.end(), {"-o", "a.exr", "-o", "a.png"});
    const Ending ending =
        run(small_mixed(more), {.folder = scratch.path(), .environment = std::move(environment)});
    EXPECT_EQ(ending.code, 0) << ending.err;
    EXPECT_EQ(names_in(scratch.path()), (Words{"a.exr", "a.png"}));
    return {bytes_of(scratch / "a.exr"), bytes_of(scratch / "a.png")};
}

TEST(Reproducible, same_command_gives_the_same_bytes) {
    const Pictures once = render({"--reproducible"});
    EXPECT_GT(once.exr.size(), 1000u);
    EXPECT_EQ(once, render({"--reproducible"}));
}

TEST(Reproducible, threads_groups_and_caches_change_no_byte) {
    const Pictures once = render({"--reproducible"});
    EXPECT_EQ(once, render({"--reproducible"}, {{"LP_NUM_THREADS", "1"}})) << "one thread";
    EXPECT_EQ(once, render({"--reproducible", "--group-size", "16x16"})) << "groups of 16x16";
    EXPECT_EQ(once, render({"--reproducible", "--group-size", "32x1"})) << "groups of 32x1";
    EXPECT_EQ(once, render({"--reproducible", "--no-cache"})) << "no cache";
}

// Photons, glass, mirrors, emitting spheres and voxels.
TEST(Reproducible, threads_and_groups_change_no_byte_of_light) {
    for (const char* name : {"cornell", "glass_block"}) {
        const auto picture = [&](Words more, std::map<std::string, std::string> environment = {}) {
            const ScratchFolder scratch;
            Words words = {
                "render", scene_file(name),     "--size", "48x40", "--spp", "3", "-q", "--reproducible",
                "-D",     "photons.count=20000"};
            words.insert(words.end(), more.begin(), more.end());
            words.insert(words.end(), {"-o", "a.exr"});
            const Ending ending =
                run(words, {.folder = scratch.path(), .environment = std::move(environment)});
            EXPECT_EQ(ending.code, 0) << ending.err;
            return bytes_of(scratch / "a.exr");
        };
        const std::string once = picture({});
        EXPECT_GT(once.size(), 1000u);
        EXPECT_EQ(once, picture({}, {{"LP_NUM_THREADS", "1"}})) << name;
        EXPECT_EQ(once, picture({"--group-size", "16x16"})) << name;
        EXPECT_NE(once, picture({"--seed", "1"})) << name << ", negative control";
    }
}

TEST(Reproducible, another_seed_or_sequence_changes_both_pictures) {
    const Pictures once = render({"--reproducible"});
    for (const Words& words :
         {Words{"--reproducible", "--seed", "1"}, Words{"--reproducible", "--sequence", "white"}}) {
        const Pictures other = render(words);
        EXPECT_NE(once.exr, other.exr);
        EXPECT_NE(once.png, other.png);
    }
}

TEST(Reproducible, without_it_the_picture_carries_times) {
    const ScratchFolder scratch;
    EXPECT_EQ(run(small_mixed({"-o", scratch / "a.exr"})).code, 0);
    EXPECT_EQ(run(small_mixed({"--reproducible", "-o", scratch / "b.exr"})).code, 0);
    const Image timed = read_exr(scratch / "a.exr");
    const Image timeless = read_exr(scratch / "b.exr");
    EXPECT_TRUE(timed.attributes.contains("capDate"));
    EXPECT_FALSE(timeless.attributes.contains("capDate"));
    EXPECT_NE(timed.attributes.at("voxilux.report").find("wall_s"), std::string::npos);
    EXPECT_EQ(timeless.attributes.at("voxilux.report").find("wall_s"), std::string::npos);
    for (const auto& [name, channel] : timed.channels)
        EXPECT_EQ(channel.pixels, timeless.channels.at(name).pixels) << name;
}

TEST(Picture, exr_has_the_channels_that_other_programs_look_for) {
    const ScratchFolder scratch;
    EXPECT_EQ(run(small_mixed({"--effect", "indirect=off", "-o", scratch / "a.exr"})).code, 0);
    const Image image = read_exr(scratch / "a.exr");
    std::set<std::string> names;
    for (const auto& [name, channel] : image.channels) {
        names.insert(name);
        const bool is_beauty = name == "R" || name == "G" || name == "B";
        EXPECT_EQ(channel.precision, is_beauty ? Image::Precision::half : Image::Precision::single) << name;
    }
    EXPECT_EQ(names, (std::set<std::string>{"R",        "G",          "B",          "Z",
                                            "N.X",      "N.Y",        "N.Z",        "P.X",
                                            "P.Y",      "P.Z",        "albedo.R",   "albedo.G",
                                            "albedo.B", "ao.Y",       "sun.Y",      "sampleCount.Y",
                                            "error.Y",  "variance.R", "variance.G", "variance.B"}));
    EXPECT_EQ(image.attributes.at("comments"), "mixed.toml");
    EXPECT_EQ(image.attributes.at("software").find("voxilux "), 0u);
    EXPECT_TRUE(image.attributes.contains("voxilux.report"));
}

TEST(Picture, absent_effect_has_no_channel) {
    const ScratchFolder scratch;
    EXPECT_EQ(run(small_mixed({"-o", scratch / "a.exr", "--effect", "ao=off", "-D", "sun.on=false"})).code,
              0);
    const Image image = read_exr(scratch / "a.exr");
    EXPECT_FALSE(image.channels.contains("ao.Y"));
    EXPECT_FALSE(image.channels.contains("sun.Y"));
    EXPECT_TRUE(image.channels.contains("Z"));
}

TEST(Picture, colour_alone_is_written_when_asked_for) {
    const ScratchFolder scratch;
    EXPECT_EQ(run(small_mixed({"-o", scratch / "a.exr", "--effect", "aov=off"})).code, 0);
    EXPECT_EQ(read_exr(scratch / "a.exr").channels.size(), 5u) << "R, G, B, sampleCount.Y, error.Y";
}

// Its corners would be farther away than 32-bit coordinates reach.
TEST(Picture, image_too_large_for_coordinates_is_refused) {
    const ScratchFolder scratch;
    const Ending ending =
        run(small_mixed({"-o", scratch / "a.exr", "--camera", "front", "-D", "camera.projection=orthographic",
                         "-D", "camera.pixels_per_voxel=1e-7"}));
    EXPECT_EQ(ending.code, 3);
    EXPECT_NE(ending.err.find("a corner of the image of the camera at"), std::string::npos) << ending.err;
    EXPECT_FALSE(std::filesystem::exists(scratch / "a.exr"));
}

// Turned either way, another pair of corners is out of reach.
TEST(Picture, every_corner_of_an_image_is_looked_at) {
    const ScratchFolder scratch;
    for (const char* yaw : {"camera.yaw=20", "camera.yaw=-20"}) {
        const Ending ending =
            run({"render", scene_file("mixed"), "--size", "20x40", "--spp", "1", "-o", scratch / "a.png",
                 "-D", "camera.projection=orthographic", "-D", "camera.pixels_per_voxel=2.22e-6", "-D",
                 "camera.position=[0, 0, 0]", "-D", yaw, "-D", "camera.pitch=-90"});
        EXPECT_EQ(ending.code, 3) << yaw << ending.err;
    }
}

// P seen through the matrices of the header, as OpenEXR applies them to row vectors, is Z in front of the
// camera and in its own pixel: OpenEXR, "Standard attributes", worldToCamera and worldToNDC.
TEST(Picture, matrices_of_the_header_take_positions_to_their_depth_and_pixel) {
    for (const Words& camera :
         {Words{"-D", "camera.position=[20, -60, 30]", "-D", "camera.look_at=[0, 0, 4]"},
          Words{"-D", "camera.position=[20, -60, 30]", "-D", "camera.look_at=[0, 0, 4]", "-D",
                "camera.pixels_per_voxel=0.7"},
          Words{"--camera", "left", "--pixels-per-voxel", "1", "--size", "48x25"}}) {
        const ScratchFolder scratch;
        EXPECT_EQ(run(small_mixed(with({"-o", scratch / "a.exr"}, camera))).code, 0);
        const Imf::InputFile file((scratch / "a.exr").c_str());
        const Imath::M44f to_camera = Imf::worldToCamera(file.header());
        const Imath::M44f to_ndc = Imf::worldToNDC(file.header());
        const Image image = read_exr(scratch / "a.exr");
        const auto value = [&](const char* name, std::size_t i) { return image.channels.at(name).pixels[i]; };
        int hits = 0;
        for (std::size_t i = 0; i < pixel_count(image); ++i) {
            if (value("Z", i) > 1e6f) continue;
            ++hits;
            const Imath::V3f p(value("P.X", i), value("P.Y", i), value("P.Z", i));
            const Imath::V3f seen = p * to_camera;
            ASSERT_NEAR(-seen.z, value("Z", i), 1e-3f) << "pixel " << i;
            const Imath::V3f ndc = p * to_ndc;
            const float column = (ndc.x + 1.0f) / 2.0f * static_cast<float>(image.width);
            const float row = (1.0f - ndc.y) / 2.0f * static_cast<float>(image.height);
            ASSERT_NEAR(column, static_cast<float>(i % 48) + 0.5f, 0.501f) << "pixel " << i;
            ASSERT_NEAR(row, static_cast<float>(i / 48) + 0.5f, 0.501f) << "pixel " << i;
        }
        EXPECT_GT(hits, 100);
    }
}

// Every channel of a crop is bit for bit that part of the whole picture, and the file says where it lies.
TEST(Picture, crop_is_that_part_of_the_whole_picture) {
    const ScratchFolder scratch;
    EXPECT_EQ(run(small_mixed({"-o", scratch / "whole.exr"})).code, 0);
    EXPECT_EQ(
        run(small_mixed({"-o", scratch / "part.exr", "-o", scratch / "part.png", "--crop", "11,7,40,22"}))
            .code,
        0);
    const Imf::InputFile file((scratch / "part.exr").c_str());
    EXPECT_EQ(file.header().dataWindow(), Imath::Box2i({11, 7}, {39, 21}));
    EXPECT_EQ(file.header().displayWindow(), Imath::Box2i({0, 0}, {47, 26}));
    EXPECT_EQ(read_png(scratch / "part.png").width, 29);
    const Image whole = read_exr(scratch / "whole.exr");
    const Image part = read_exr(scratch / "part.exr");  // of the size of the whole, zero outside
    for (const auto& [name, channel] : whole.channels) {
        for (std::size_t i = 0; i < channel.pixels.size(); ++i) {
            const std::size_t x = i % 48, y = i / 48;
            const bool is_inside = x >= 11 && x < 40 && y >= 7 && y < 22;
            ASSERT_EQ(part.channels.at(name).pixels[i], is_inside ? channel.pixels[i] : 0.0f)
                << name << " of pixel " << x << ", " << y;
        }
    }
}

TEST(Picture, png_is_the_tone_mapped_exr) {
    const ScratchFolder scratch;
    EXPECT_EQ(run(small_mixed({"-o", scratch / "a.exr", "-o", scratch / "a.png", "--exposure", "-1"})).code,
              0);
    const Image png = read_png(scratch / "a.png");
    const Image shown = to_display(read_exr(scratch / "a.exr"), {.exposure_ev = -1.0f}).image;
    // The EXR has been rounded to half precision on its way: one 8-bit code of difference at most.
    for (const char* name : {"R", "G", "B"}) {
        const std::vector<float>& a = png.channels.at(name).pixels;
        const std::vector<float>& b = shown.channels.at(name).pixels;
        for (std::size_t i = 0; i < a.size(); ++i)
            ASSERT_NEAR(a[i], b[i], 0.01f) << name << " of pixel " << i;
    }
}

TEST(Picture, tone_and_exposure_change_the_png) {
    const ScratchFolder scratch;
    std::set<std::string> pictures;
    for (const Words& more : {Words{}, Words{"--tone", "plain"}, Words{"--exposure", "1"}}) {
        Words words = small_mixed({"-o", scratch / "a.png"});
        words.insert(words.end(), more.begin(), more.end());
        EXPECT_EQ(run(words).code, 0);
        pictures.insert(bytes_of(scratch / "a.png"));
    }
    EXPECT_EQ(pictures.size(), 3u);
}

TEST(PictureNightly, every_side_shows_another_picture) {
    const ScratchFolder scratch;
    std::set<std::string> pictures;
    for (const char* side : {"three-quarter", "front", "back", "left", "right", "top", "iso"}) {
        EXPECT_EQ(run(small_mixed({"-o", scratch / "a.png", "--camera", side})).code, 0);
        pictures.insert(bytes_of(scratch / "a.png"));
    }
    EXPECT_EQ(pictures.size(), 7u);
}

TEST(Picture, default_camera_is_the_three_quarter_view) {
    const ScratchFolder scratch;
    EXPECT_EQ(run(small_mixed({"-o", scratch / "a.png"})).code, 0);
    EXPECT_EQ(run(small_mixed({"-o", scratch / "b.png", "--camera", "three-quarter"})).code, 0);
    EXPECT_EQ(bytes_of(scratch / "a.png"), bytes_of(scratch / "b.png"));
}

TEST(Picture, capital_ending_is_an_ending) {
    const ScratchFolder scratch;
    EXPECT_EQ(run(small_mixed({"-o", scratch / "a.EXR", "-o", scratch / "a.PNG"})).code, 0);
    EXPECT_EQ(read_exr(scratch / "a.EXR").width, 48);
    EXPECT_EQ(read_png(scratch / "a.PNG").width, 48);
}

// Extremes of size: a single pixel, a strip far wider than any screen, nothing in the scene.
TEST(Picture, extreme_sizes_and_an_empty_scene_work) {
    const ScratchFolder scratch;
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"one_voxel", "1x1"}, {"mixed", "16384x16"}, {"mixed", "16x4096"}, {"empty", "64x36"}};
    for (const auto& [scene, size] : cases) {
        const Words words = {"render", scene_file(scene), "--size", size, "--spp", "1", "-q",
                             "-o",     scratch / "a.exr"};
        const Ending ending = run(words);
        EXPECT_EQ(ending.code, 0) << size << ": " << ending.err;
        const Image image = read_exr(scratch / "a.exr");
        EXPECT_EQ(std::to_string(image.width) + "x" + std::to_string(image.height), size);
    }
}

TEST(Picture, time_limit_ends_in_time_with_a_whole_picture) {
    const ScratchFolder scratch;
    const auto start = std::chrono::steady_clock::now();
    const Words words = {"render",         scene_file("mixed"), "--size", "640x360", "--spp",
                         "1000000",        "--time-limit",      "2s",     "-q",      "-o",
                         scratch / "a.exr"};
    EXPECT_EQ(run(words).code, 0);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    EXPECT_GE(seconds, 1.0) << "what is reserved for the last dispatch tile and the files, as a strip "
                               "predicted, is less than half";
    EXPECT_LE(seconds, 2.0 + 2.0) << "the limit, and 2 s for the last dispatch tile and the files";
    const Image image = read_exr(scratch / "a.exr");
    for (const float samples : image.channels.at("sampleCount.Y").pixels)
        ASSERT_GE(samples, 1.0f);
}

}  // namespace
}  // namespace voxilux::test
