#include "formats/png.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "base/colour.h"
#include "base/error.h"
#include "base/file.h"
#include "film/tonemap.h"
#include "support/scratch_folder.h"
#include "support/test_images.h"

using namespace voxilux;
namespace fs = std::filesystem;

namespace {

Error png_error_of(const std::function<void()>& action) {
    try {
        action();
    } catch (const Error& error) {
        return error;
    }
    return Error(ExitCode::done, "no error");
}

}  // namespace

TEST(Png, every_code_round_trips_bit_exact) {
    const ScratchFolder folder;
    const Image image = test::code_image(
        256, 3, [](int x, int y, int c) { return static_cast<std::uint32_t>(y == c ? x : 255 - x); });
    write_png(folder / "a.png", image);
    const Image read = read_png(folder / "a.png");
    EXPECT_EQ(read.width, 256);
    EXPECT_EQ(read.height, 3);
    EXPECT_TRUE(read.display_referred);
    for (const char* name : {"R", "G", "B"})
        EXPECT_EQ(read.channels.at(name).pixels, image.channels.at(name).pixels) << name;
    EXPECT_FALSE(read.channels.contains("A"));
}

TEST(Png, alpha_round_trips_linear) {
    const ScratchFolder folder;
    Image image = test::noise_image(16, 16, 2);
    image.channels["A"].pixels.resize(256);
    for (std::size_t i = 0; i < 256; ++i)
        image.channels["A"].pixels[i] = static_cast<float>(i) / 255.0f;
    write_png(folder / "a.png", image);
    EXPECT_EQ(read_png(folder / "a.png").channels.at("A").pixels, image.channels.at("A").pixels);
}

TEST(Png, row_zero_is_the_top_row) {
    const ScratchFolder folder;
    write_png(folder / "a.png", test::rgb_image(1, 2, [](int, int y, int) { return y == 0 ? 1.0f : 0.0f; }));
    const Image read = read_png(folder / "a.png");
    EXPECT_EQ(read.channels.at("R").pixels, (std::vector<float>{1.0f, 0.0f}));
}

TEST(Png, same_image_twice_gives_the_same_bytes) {
    const ScratchFolder folder;
    const Image image = test::noise_image(257, 131, 9);
    write_png(folder / "a.png", image);
    const std::vector<char> heap_in_another_state(12345);
    write_png(folder / "b.png", image);
    EXPECT_EQ(read_file(folder / "a.png"), read_file(folder / "b.png"));
    write_png(folder / "c.png", test::noise_image(257, 131, 10));  // negative control
    EXPECT_NE(read_file(folder / "a.png"), read_file(folder / "c.png"));
}

TEST(Png, display_image_stores_exactly_its_codes) {
    const ScratchFolder folder;
    const Image linear =
        test::rgb_image(64, 4, [](int x, int y, int c) { return 0.01f * static_cast<float>(x * (y + c)); });
    const DisplayImage display = to_display(linear);
    write_png(folder / "a.png", display.image);
    EXPECT_EQ(read_png(folder / "a.png").channels.at("G").pixels, display.image.channels.at("G").pixels);
}

TEST(Png, single_pixel_and_single_row_work) {
    const ScratchFolder folder;
    for (const auto& [width, height] : {std::pair{1, 1}, {1, 300}, {16384, 16}}) {
        write_png(folder / "a.png", test::constant_image(width, height, 0.5f));
        const Image read = read_png(folder / "a.png");
        EXPECT_EQ(read.width, width);
        EXPECT_EQ(read.height, height);
    }
}

TEST(Png, file_cut_at_any_byte_is_refused) {
    const ScratchFolder folder;
    write_png(folder / "a.png", test::noise_image(5, 4, 1));
    const std::vector<std::byte> bytes = read_file(folder / "a.png");
    // The last 12 bytes are the IEND chunk, which the decoder does not miss once it has every pixel.
    for (std::size_t size = 0; size + 12 < bytes.size(); ++size) {
        const Error error = png_error_of([&] { (void)decode_png(std::span(bytes).first(size), "cut.png"); });
        EXPECT_EQ(error.code(), ExitCode::input_refused) << size;
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
}

TEST(Png, size_beyond_the_cap_is_refused_before_decoding) {
    const ScratchFolder folder;
    write_png(folder / "a.png", test::noise_image(5, 4, 1));
    std::vector<std::byte> bytes = read_file(folder / "a.png");
    bytes[16] = std::byte{0x00};  // width 0x00FFFFFF
    bytes[17] = bytes[18] = bytes[19] = std::byte{0xFF};
    const Error error = png_error_of([&] { (void)decode_png(bytes, "big.png"); });
    EXPECT_EQ(error.code(), ExitCode::input_refused);
    EXPECT_NE(std::string(error.what()).find("big.png"), std::string::npos);
}

TEST(Png, absent_file_and_folder_are_refused) {
    const ScratchFolder folder;
    EXPECT_EQ(png_error_of([&] { (void)read_png(folder / "absent.png"); }).code(), ExitCode::input_refused);
    EXPECT_EQ(png_error_of([&] { (void)read_png(folder.path()); }).code(), ExitCode::input_refused);
}

TEST(Png, writing_onto_a_folder_fails_and_leaves_nothing) {
    const ScratchFolder folder;
    fs::create_directory(folder / "a.png");
    EXPECT_EQ(png_error_of([&] { write_png(folder / "a.png", test::constant_image(2, 2, 0)); }).code(),
              ExitCode::cannot_write);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 1);
}
