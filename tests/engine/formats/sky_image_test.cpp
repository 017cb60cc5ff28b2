// Images of the sky from files: Radiance files are written here, byte by byte.

#include "formats/sky_image.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>

#include "base/error.h"
#include "base/file.h"
#include "formats/exr.h"
#include "formats/hdr.h"
#include "formats/scene_toml.h"
#include "scene/facts.h"
#include "support/scratch_folder.h"
#include "support/vox_builder.h"

namespace voxilux {
namespace {

constexpr const char* kHdrHead = "#?RADIANCE\n# ours\nEXPOSURE=1\nFORMAT=32-bit_rle_rgbe\n\n";

std::string hdr_file(int width, int height, const std::string& pixels) {
    return std::string(kHdrHead) + fmt::format("-Y {} +X {}\n", height, width) + pixels;
}

// A row of ten pixels in runs: red 0 to 9, green 7 everywhere, blue 3 twice and 4 to 11, exponent 129.
std::string row_of_runs() {
    std::string row = {2, 2, 0, 10};
    row += std::string{10, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9};
    row += std::string{static_cast<char>(138), 7};
    row += std::string{static_cast<char>(130), 3, 8, 4, 5, 6, 7, 8, 9, 10, 11};
    row += std::string{static_cast<char>(133), static_cast<char>(129), static_cast<char>(133),
                       static_cast<char>(129)};
    return row;
}

Image decoded_hdr(const std::string& bytes) {
    return decode_hdr(std::as_bytes(std::span(bytes)), "a.hdr");
}

std::string hdr_refusal(const std::string& bytes) {
    try {
        (void)decoded_hdr(bytes);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::input_refused);
        return error.what();
    }
    return "accepted";
}

TEST(Hdr, runs_and_plain_pixels_are_mantissas_times_powers_of_two) {
    const Image runs = decoded_hdr(hdr_file(10, 1, row_of_runs()));
    ASSERT_EQ(runs.width, 10);
    for (std::size_t x = 0; x < 10; ++x) {
        EXPECT_EQ(runs.channels.at("R").pixels[x], static_cast<float>(x) / 128.0f);
        EXPECT_EQ(runs.channels.at("G").pixels[x], 7.0f / 128.0f);
        EXPECT_EQ(runs.channels.at("B").pixels[x], (x < 2 ? 3.0f : static_cast<float>(x + 2)) / 128.0f);
    }
    const Image plain = decoded_hdr(hdr_file(
        2, 2, {1, 2, 4, static_cast<char>(136), 9, 9, 9, 0, 2, 2, 0, 1, 0, 0, 1, static_cast<char>(255)}));
    EXPECT_EQ(plain.channels.at("B").pixels[0], 4.0f);
    EXPECT_EQ(plain.channels.at("R").pixels[1], 0.0f) << "an exponent of 0 is black";
    EXPECT_EQ(plain.channels.at("R").pixels[2], 2.0f * std::ldexp(1.0f, 1 - 136)) << "too narrow for runs";
    EXPECT_EQ(plain.channels.at("B").pixels[3], std::ldexp(1.0f, 255 - 136));
}

TEST(Hdr, files_that_end_early_are_refused_wherever_they_end) {
    const std::string whole = hdr_file(10, 1, row_of_runs());
    EXPECT_EQ(hdr_refusal(whole), "accepted");
    for (std::size_t bytes = 0; bytes < whole.size(); ++bytes)
        EXPECT_NE(hdr_refusal(whole.substr(0, bytes)), "accepted") << bytes;
    EXPECT_EQ(hdr_refusal(whole.substr(0, whole.size() - 1)),
              "a.hdr: not a readable Radiance image: the file ends early");
}

TEST(Hdr, hostile_files_are_refused_in_one_line) {
    const auto expect = [](const std::string& bytes, const char* why) {
        EXPECT_EQ(hdr_refusal(bytes), std::string("a.hdr: not a readable Radiance image: ") + why);
    };
    expect("#?RGBX\n\n-Y 1 +X 1\nabcd", "it does not begin as one does");
    expect("#?RGBE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\nabcd", "its format is not 32-bit_rle_rgbe");
    for (const char* size :
         {"+Y 1 +X 1", "-Y 0 +X 1", "-Y 1 +X -1", "-Y 1", "-Y 1 +X 1 ", "-Y 99999999999 +X 1"})
        expect(std::string(kHdrHead) + size + "\nabcd", "its size is not of the form '-Y HEIGHT +X WIDTH'");
    expect(hdr_file(16384, 8192, "abcd"), "16384x8192 pixels, over the limit of 8388608 in all");
    expect(hdr_file(2147483647, 2147483647, ""),
           "2147483647x2147483647 pixels, over the limit of 8388608 in all");
    std::string row = row_of_runs();
    row[4] = 11;
    expect(hdr_file(10, 1, row), "a run leaves its row");
    row[4] = 0;
    expect(hdr_file(10, 1, row), "a run leaves its row");
    expect(hdr_file(11, 1, row), "a row has another width than the image");
    expect("#?RGBE\n" + std::string(5000, 'a'), "a line of its header does not end");
    std::string lines = "#?RGBE\n";
    for (int i = 0; i < 2000; ++i)
        lines += "a\n";
    expect(lines, "its header has over 1024 lines");
}

void write_text(const std::filesystem::path& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
}

// Of one channel and one row, whatever the values are.
void write_raw_exr(const std::filesystem::path& path, std::vector<float> values) {
    const int width = static_cast<int>(values.size());
    Imf::Header header(width, 1);
    header.channels().insert("Y", Imf::Channel(Imf::FLOAT));
    Imf::FrameBuffer frame;
    frame.insert("Y", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data()), sizeof(float), 0));
    Imf::OutputFile file(path.c_str(), header);
    file.setFrameBuffer(frame);
    file.writePixels(1);
}

void write_sky_exr(const std::filesystem::path& path, int width, int height,
                   const std::vector<float>& values) {
    const std::array<std::string, 1> names{"Y"};
    Image image = make_image(width, height, names);
    if (!values.empty()) image.channels.at("Y").pixels = values;
    write_exr(path, image);
}

std::string sky_refusal(const std::filesystem::path& path) {
    std::vector<std::string> warnings;
    try {
        (void)load_sky_image(path, warnings);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::input_refused);
        return error.what();
    }
    return "accepted";
}

TEST(SkyImageFile, exr_is_read_row_by_row) {
    const ScratchFolder folder;
    std::vector<float> values;
    for (int i = 0; i < 5 * 37; ++i)
        values.push_back(static_cast<float>(i));
    write_sky_exr(folder / "a.exr", 5, 37, values);
    std::vector<std::string> warnings;
    const SkyImage sky = load_sky_image(folder / "a.exr", warnings);
    EXPECT_EQ(sky.size, glm::ivec2(5, 37));
    ASSERT_EQ(sky.texels.size(), values.size());
    for (std::size_t i = 0; i < values.size(); ++i)
        EXPECT_EQ(sky.texels[i], glm::vec3(values[i]));
    EXPECT_TRUE(warnings.empty());
}

TEST(SkyImageFile, numbers_that_are_no_radiance_are_repaired_and_counted) {
    const ScratchFolder folder;
    write_text(folder / "a.hdr",
               hdr_file(2, 1, {1, 0, 0, static_cast<char>(255), 1, 1, 1, static_cast<char>(136)}));
    std::vector<std::string> warnings;
    const SkyImage sky = load_sky_image(folder / "a.hdr", warnings);
    EXPECT_EQ(sky.texels[0], glm::vec3(1e6f, 0.0f, 0.0f));
    EXPECT_EQ(sky.texels[1], glm::vec3(1.0f));
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find("a.hdr: 1 of 2 texels hold a value that is negative, not a number or above"),
              std::string::npos)
        << warnings[0];
    using Limits = std::numeric_limits<float>;
    write_raw_exr(folder / "b.exr", {-1.0f, Limits::quiet_NaN(), Limits::infinity(), -Limits::infinity(),
                                     0.5f, -0.0f, Limits::denorm_min()});
    const SkyImage raw = load_sky_image(folder / "b.exr", warnings);
    const float expected[] = {0.0f, 0.0f, 1e6f, 0.0f, 0.5f, 0.0f, Limits::denorm_min()};
    for (std::size_t i = 0; i < raw.texels.size(); ++i)
        EXPECT_EQ(raw.texels[i], glm::vec3(expected[i])) << i;
    ASSERT_EQ(warnings.size(), 2u);
    EXPECT_NE(warnings[1].find("4 of 7 texels"), std::string::npos) << warnings[1];
}

TEST(SkyImageFile, what_is_no_image_of_a_sky_is_refused) {
    const ScratchFolder folder;
    write_text(folder / "a.exr", "no image");
    EXPECT_EQ(sky_refusal(folder / "a.exr"),
              (folder / "a.exr").string() + ": neither an EXR nor a Radiance image (.hdr)");
    EXPECT_NE(sky_refusal(folder / "absent.exr"), "accepted");
    EXPECT_NE(sky_refusal(folder.path()), "accepted");
    const std::array<std::string, 1> depth{"Z"};
    write_exr(folder / "z.exr", make_image(2, 2, depth));
    EXPECT_EQ(sky_refusal(folder / "z.exr"),
              (folder / "z.exr").string() + ": no image of a sky: it has neither R, G and B nor Y");
    write_sky_exr(folder / "large.exr", 131072, 65, {});
    EXPECT_EQ(sky_refusal(folder / "large.exr"),
              (folder / "large.exr").string() +
                  ": an image of a sky may have 8388608 texels (4096x2048), this one has 131072x65");
}

TEST(SkyImageFile, scene_names_it_relative_to_itself) {
    const ScratchFolder folder;
    write_sky_exr(folder / "a.exr", 2, 1, {1.0f, 3.0f});
    const auto scene_of = [&](const std::string& text, const LoadOptions& options = {}) {
        return parse_scene(text, folder / "s.toml", options);
    };
    const Scene scene = scene_of("[sky]\nimage = \"a.exr\"\nrotation = 30\nstrength = 2\n");
    EXPECT_EQ(scene.sky.model, SkyModel::image);
    EXPECT_EQ(scene.sky.image.size, glm::ivec2(2, 1));
    EXPECT_EQ(scene.sky.rotation_deg, 30.0f);
    const SceneFacts facts = measure_scene(scene);
    EXPECT_TRUE(facts.has_sky);
    EXPECT_EQ(facts.sky_image, glm::ivec2(2, 1));
    EXPECT_TRUE(scene_of("[sky]\nmodel = \"constant\"\nimage = \"a.exr\"\n").sky.image.texels.empty());
    EXPECT_EQ(scene_of("", {.overrides = {"sky.image=a.exr"}}).sky.image.size, glm::ivec2(2, 1));
    EXPECT_FALSE(measure_scene(scene_of("[sky]\nimage = \"a.exr\"\nstrength = 0\n")).has_sky);
    const auto refusal_of = [&](const std::string& text) -> std::string {
        try {
            (void)scene_of(text);
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::input_refused);
            return error.what();
        }
        return "accepted";
    };
    EXPECT_NE(refusal_of("[sky]\nmodel = \"image\"\n")
                  .find("s.toml:1:1: [sky] with the model 'image' needs 'image'"),
              std::string::npos);
    EXPECT_NE(refusal_of("[sky]\nimage = \"b.exr\"\n").find("s.toml:2:9: 'image' in [sky] cannot be used: "),
              std::string::npos);
}

TEST(SkyImageFile, vox_file_uses_what_is_beside_it_and_nothing_else) {
    using namespace vox_builder;
    const ScratchFolder folder;
    const auto vox_with = [&](const std::string& path) {
        const std::string objects =
            chunk("rOBJ", dict({{"_type", "_env"}, {"_mode", "2"}})) +
            chunk("rOBJ", dict({{"_type", "_ibl"}, {"_path", path}, {"_i", "2"}, {"_rot", "90"}}));
        write_file_atomically(folder / "m.vox", vox_builder::file(chiral_model(2, 2, 2) + objects));
        return load_scene(folder / "m.vox");
    };
    const Scene absent = vox_with("night.hdr");
    EXPECT_EQ(absent.sky.model, SkyModel::constant);
    EXPECT_EQ(absent.sky.strength, 1.0f);
    ASSERT_EQ(absent.notes.size(), 1u);
    EXPECT_NE(absent.notes[0].find("the image of the sky cannot be used, and our sky is shown"),
              std::string::npos);
    write_text(folder / "night.hdr", hdr_file(1, 1, {1, 1, 1, static_cast<char>(136)}));
    for (const char* path : {"night.hdr", "C:\\hdri\\night.hdr", "../../elsewhere/night.hdr", "/night.hdr"}) {
        const Scene scene = vox_with(path);
        EXPECT_EQ(scene.sky.image.size, glm::ivec2(1)) << path;
        EXPECT_TRUE(scene.notes.empty());
        EXPECT_EQ(scene.sky.strength, 2.0f);
        EXPECT_EQ(scene.sky.rotation_deg, 0.0f);
    }
    for (const char* path : {"", "..", "a/..", "/"})
        EXPECT_EQ(vox_with(path).sky.model, SkyModel::constant) << path;
    const Scene other = load_scene(folder / "m.vox", {.overrides = {"sky.model=constant"}});
    EXPECT_EQ(other.sky.model, SkyModel::constant);
    EXPECT_TRUE(load_scene(folder / "m.vox", {.ignores_file_settings = true}).sky.image.texels.empty());
}

}  // namespace
}  // namespace voxilux
