#include "formats/exr.h"

#include <gtest/gtest.h>
#include <sys/fsuid.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>

#include "base/error.h"
#include "base/file.h"
#include "support/scratch_folder.h"
#include "support/test_images.h"

using namespace voxilux;
namespace fs = std::filesystem;

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

Error error_of(const std::function<void()>& action) {
    try {
        action();
    } catch (const Error& error) {
        return error;
    }
    return Error(ExitCode::done, "no error");
}

// A beauty of exact halves and AOVs of arbitrary floats.
Image sample_image(int width, int height) {
    Image image = test::rgb_image(width, height, [&](int x, int y, int c) {
        return std::ldexp(
            static_cast<float>(test::hash32(static_cast<std::uint32_t>(x + 7919 * y + 31 * c)) & 2047u), -7);
    });
    for (auto& [name, channel] : image.channels)
        channel.precision = Image::Precision::half;
    for (const char* name : {"Z", "N.X", "ao.Y", "sampleCount.Y"}) {
        std::vector<float>& plane = image.channels[name].pixels;
        for (std::size_t i = 0; i < pixel_count(image); ++i) {
            const std::uint32_t bits =
                test::hash32(static_cast<std::uint32_t>(i) + static_cast<std::uint32_t>(name[0]));
            plane.push_back(static_cast<float>(bits) * 1e-7f);
        }
    }
    image.attributes["voxilux.report"] = "{\"seed\":1}";
    return image;
}

void expect_same_bits(const std::vector<float>& a, const std::vector<float>& b) {
    ASSERT_EQ(a.size(), b.size());
    EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(float)), 0);
}

std::vector<std::byte> bytes_of(const ScratchFolder& folder, const Image& image, const ExrOptions& options) {
    write_exr(folder / "bytes.exr", image, options);
    return read_file(folder / "bytes.exr");
}

std::size_t files_in(const fs::path& folder) {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

}  // namespace

TEST(Exr, every_channel_round_trips_bit_exact) {
    const ScratchFolder folder;
    for (const auto& [width, height] : {std::pair{1, 1}, {1, 100}, {37, 21}, {16384, 16}}) {
        const Image image = sample_image(width, height);
        const WriteReport report = write_exr(folder / "a.exr", image);
        EXPECT_EQ(report.clamped + report.non_finite, 0u);
        const Image read = read_exr(folder / "a.exr");
        EXPECT_EQ(read.width, width);
        EXPECT_EQ(read.height, height);
        ASSERT_EQ(read.channels.size(), image.channels.size());
        for (const auto& [name, channel] : image.channels) {
            expect_same_bits(read.channels.at(name).pixels, channel.pixels);
            EXPECT_EQ(read.channels.at(name).precision, channel.precision) << name;
        }
        EXPECT_EQ(read.attributes.at("voxilux.report"), "{\"seed\":1}");
        EXPECT_FALSE(read.display_referred);
    }
}

TEST(Exr, round_trip_of_a_perturbed_value_differs) {  // negative control
    const ScratchFolder folder;
    Image image = sample_image(8, 8);
    write_exr(folder / "a.exr", image);
    image.channels["Z"].pixels[63] = std::nextafter(image.channels["Z"].pixels[63], kInfinity);
    const std::vector<float> read = read_exr(folder / "a.exr").channels.at("Z").pixels;
    EXPECT_NE(std::memcmp(read.data(), image.channels["Z"].pixels.data(), 64 * sizeof(float)), 0);
}

TEST(Exr, row_zero_is_the_top_row) {
    const ScratchFolder folder;
    Image image{.width = 1, .height = 2};
    image.channels["Z"].pixels = {1.0f, 2.0f};
    write_exr(folder / "a.exr", image);
    EXPECT_EQ(read_exr(folder / "a.exr").channels.at("Z").pixels, (std::vector<float>{1.0f, 2.0f}));
}

TEST(Exr, what_does_not_fit_is_clamped_and_counted) {
    const ScratchFolder folder;
    Image image{.width = 8, .height = 1};
    const std::vector<float> hard = {65504.0f, 65505.0f, -1e30f, kNan, kInfinity, -kInfinity, 1e-45f, -0.0f};
    image.channels["R"] = {Image::Precision::half, hard};
    image.channels["Z"] = {Image::Precision::single, hard};
    const WriteReport report = write_exr(folder / "a.exr", image);
    EXPECT_EQ(report.clamped, 2u);     // 65505 and -1e30, in the half channel only
    EXPECT_EQ(report.non_finite, 6u);  // three in each
    const Image read = read_exr(folder / "a.exr");
    const float largest = std::numeric_limits<float>::max();
    expect_same_bits(read.channels.at("R").pixels, {65504, 65504, -65504, 0, 65504, -65504, 0, -0.0f});
    expect_same_bits(read.channels.at("Z").pixels,
                     {65504, 65505, -1e30f, 0, largest, -largest, 1e-45f, -0.0f});
}

TEST(Exr, crop_lies_in_its_frame) {
    const ScratchFolder folder;
    Image image{.width = 2, .height = 2};
    image.channels["Y"].pixels = {1, 2, 3, 4};
    write_exr(folder / "a.exr", image, {.window = {.x = 1, .y = 2, .full_width = 4, .full_height = 5}});
    const Image read = read_exr(folder / "a.exr");
    EXPECT_EQ(read.width, 4);
    EXPECT_EQ(read.height, 5);
    EXPECT_EQ(read.channels.at("Y").pixels,
              (std::vector<float>{0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 2, 0, 0, 3, 4, 0, 0, 0, 0, 0}));
}

TEST(Exr, data_outside_the_frame_is_dropped) {
    const ScratchFolder folder;
    Image image{.width = 3, .height = 3};
    image.channels["Y"].pixels = {1, 2, 3, 4, 5, 6, 7, 8, 9};
    write_exr(folder / "a.exr", image, {.window = {.x = -1, .y = -1, .full_width = 2, .full_height = 1}});
    EXPECT_EQ(read_exr(folder / "a.exr").channels.at("Y").pixels, (std::vector<float>{5, 6}));
}

TEST(Exr, reproducible_files_are_byte_identical_and_carry_no_date) {
    const ScratchFolder folder;
    Image image = sample_image(33, 12);
    image.attributes["capDate"] = "2001:01:01 00:00:00";
    EXPECT_EQ(bytes_of(folder, image, {.reproducible = true}),
              bytes_of(folder, image, {.reproducible = true}));
    EXPECT_FALSE(read_exr(folder / "bytes.exr").attributes.contains("capDate"));
    image.channels["Z"].pixels[5] += 1.0f;  // negative control
    EXPECT_NE(bytes_of(folder, sample_image(33, 12), {.reproducible = true}),
              bytes_of(folder, image, {.reproducible = true}));
}

TEST(Exr, header_carries_the_standard_attributes) {
    const ScratchFolder folder;
    glm::mat4 camera(1.0f);
    camera[3] = glm::vec4(7.0f, 8.0f, 9.0f, 1.0f);
    const std::vector<std::byte> bytes = bytes_of(
        folder, sample_image(2, 2), {.software = "voxilux 1", .comments = "hi", .world_to_camera = camera});
    const Image read = read_exr(folder / "bytes.exr");
    EXPECT_EQ(read.attributes.at("software"), "voxilux 1");
    EXPECT_EQ(read.attributes.at("comments"), "hi");
    EXPECT_EQ(read.attributes.at("capDate").size(), 19u);
    const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    // Row vectors: the translation is the last row, floats 12 to 14 of the 16 after name, type and size.
    const std::string key("worldToCamera\0m44f\0\x40\0\0\0", 23);
    const std::size_t at = text.find(key);
    ASSERT_NE(at, std::string::npos);
    float matrix[16];
    std::memcpy(matrix, text.data() + at + key.size(), sizeof matrix);
    EXPECT_EQ(matrix[12], 7.0f);
    EXPECT_EQ(matrix[14], 9.0f);
    EXPECT_NE(text.find("chromaticities"), std::string::npos);
    EXPECT_EQ(text.find("worldToNDC"), std::string::npos);
}

TEST(ExrWrite, existing_file_is_replaced_whole) {
    const ScratchFolder folder;
    std::ofstream(folder / "a.exr") << "old";
    write_exr(folder / "a.exr", sample_image(3, 3));
    EXPECT_EQ(read_exr(folder / "a.exr").width, 3);
    EXPECT_EQ(files_in(folder.path()), 1u);
}

TEST(ExrWrite, path_that_is_a_folder_cannot_be_written) {
    const ScratchFolder folder;
    fs::create_directory(folder / "a.exr");
    const Error error = error_of([&] { write_exr(folder / "a.exr", sample_image(3, 3)); });
    EXPECT_EQ(error.code(), ExitCode::cannot_write);
    EXPECT_NE(std::string(error.what()).find("directory"), std::string::npos) << error.what();
    EXPECT_EQ(files_in(folder.path()), 1u);
}

TEST(ExrWrite, absent_folder_cannot_be_written) {
    const ScratchFolder folder;
    const Error error = error_of([&] { write_exr(folder / "absent/a.exr", sample_image(3, 3)); });
    EXPECT_EQ(error.code(), ExitCode::cannot_write);
    EXPECT_NE(std::string(error.what()).find("No such file"), std::string::npos) << error.what();
}

class FileSizeLimit {
  public:
    explicit FileSizeLimit(rlim_t bytes) {
        ::getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit limit{bytes, before_.rlim_max};
        handler_ = std::signal(SIGXFSZ, SIG_IGN);
        ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    FileSizeLimit(const FileSizeLimit&) = delete;
    FileSizeLimit& operator=(const FileSizeLimit&) = delete;
    ~FileSizeLimit() {
        ::setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, handler_);
    }

  private:
    rlimit before_{};
    void (*handler_)(int) = SIG_DFL;
};

// With a limit on file sizes every write fails as on a full disk.
TEST(ExrWrite, full_disk_is_reported_and_the_old_file_stays) {
    const ScratchFolder folder;
    std::ofstream(folder / "a.exr") << "old";
    for (const int edge : {1, 64, 512}) {  // small ones fail only when they are closed
        const FileSizeLimit limit(100);
        const Error error = error_of([&] { write_exr(folder / "a.exr", sample_image(edge, edge)); });
        EXPECT_EQ(error.code(), ExitCode::cannot_write);
        EXPECT_NE(std::string(error.what()).find("File too large"), std::string::npos) << error.what();
        EXPECT_EQ(files_in(folder.path()), 1u);
        EXPECT_EQ(fs::file_size(folder / "a.exr"), 3u);
    }
}

// Root passes every permission check, so for the time of the write the thread accesses files as another user.
TEST(ExrWrite, read_only_folder_is_reported) {
    const ScratchFolder folder;
    fs::permissions(folder.path(), fs::perms::owner_read | fs::perms::owner_exec | fs::perms::others_exec |
                                       fs::perms::others_read);
    constexpr uid_t kNobody = 65534;
    const int before = ::geteuid() == 0 ? ::setfsuid(kNobody) : -1;
    const Error error = error_of([&] { write_exr(folder / "a.exr", sample_image(3, 3)); });
    if (before >= 0) ::setfsuid(static_cast<uid_t>(before));
    fs::permissions(folder.path(), fs::perms::owner_all);
    EXPECT_EQ(error.code(), ExitCode::cannot_write);
    EXPECT_NE(std::string(error.what()).find("Permission denied"), std::string::npos) << error.what();
}

TEST(ExrRead, file_cut_at_any_byte_is_refused) {
    const ScratchFolder folder;
    const std::vector<std::byte> bytes = bytes_of(folder, sample_image(6, 5), {});
    for (std::size_t size = 0; size < bytes.size(); ++size) {
        const Error error = error_of([&] { (void)decode_exr(std::span(bytes).first(size), "cut.exr"); });
        EXPECT_EQ(error.code(), ExitCode::input_refused) << size;
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
}

TEST(ExrRead, damaged_bytes_give_an_image_or_a_refusal) {
    const ScratchFolder folder;
    const std::vector<std::byte> good = bytes_of(folder, sample_image(6, 5), {});
    int refused = 0;
    for (std::uint32_t trial = 0; trial < 300; ++trial) {
        std::vector<std::byte> bytes = good;
        for (std::uint32_t k = 0; k <= trial % 4; ++k) {
            const std::uint32_t h = test::hash32(trial * 4 + k);
            bytes[h % bytes.size()] = static_cast<std::byte>(h >> 24);
        }
        try {
            const Image image = decode_exr(bytes, "damaged.exr");
            for (const auto& [name, channel] : image.channels)
                EXPECT_EQ(channel.pixels.size(), pixel_count(image));
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::input_refused);
            ++refused;
        }
    }
    EXPECT_GT(refused, 20);
}

TEST(ExrRead, window_that_the_file_cannot_fill_is_refused) {
    const ScratchFolder folder;
    std::vector<std::byte> bytes = bytes_of(folder, sample_image(6, 5), {});
    std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    for (const std::int32_t side : {1 << 15, 1 << 20, std::numeric_limits<std::int32_t>::max()}) {
        for (const std::string name : {"dataWindow", "displayWindow"}) {
            const std::size_t at = text.find(name) + name.size() + 1 + sizeof("box2i") + 4;
            const std::int32_t box[4] = {0, 0, side - 1, side - 1};
            std::memcpy(bytes.data() + at, box, sizeof box);
        }
        const Error error = error_of([&] { (void)decode_exr(bytes, "big.exr"); });
        EXPECT_EQ(error.code(), ExitCode::input_refused);
        EXPECT_NE(std::string(error.what()).find("big.exr"), std::string::npos);
    }
}

TEST(ExrRead, absent_file_and_folder_and_text_are_refused) {
    const ScratchFolder folder;
    std::ofstream(folder / "text.exr") << "not a picture";
    EXPECT_EQ(error_of([&] { (void)read_exr(folder / "absent.exr"); }).code(), ExitCode::input_refused);
    EXPECT_EQ(error_of([&] { (void)read_exr(folder.path()); }).code(), ExitCode::input_refused);
    EXPECT_EQ(error_of([&] { (void)read_exr(folder / "text.exr"); }).code(), ExitCode::input_refused);
}
