// Hard case 39: pictures of every shape, and the same picture whatever the threads.

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "base/error.h"
#include "base/file.h"
#include "frame/footprint.h"
#include "support/frame_fixture.h"
#include "support/test_scenes.h"

namespace voxilux {
namespace {

namespace fs = std::filesystem;

Scene one_voxel(glm::ivec2 size) {
    Scene scene = test::white_scene();
    test::add_box(scene, {0, 0, 0}, {1, 1, 1});
    scene.sun.on = true;
    scene.camera = test::camera_towards({3, -4, 2}, {0.5, 0.5, 0.5}, 60.0);
    scene.settings.size = size;
    return scene;
}

TEST(HardCase, row39_pictures_of_one_pixel_one_row_and_one_column_have_their_size) {
    for (const glm::ivec2 size : {glm::ivec2(1, 1), {1, 37}, {37, 1}, {65, 9}, {16384, 16}, {16, 16384}}) {
        const Image image = test::render_validated(one_voxel(size)).image;
        EXPECT_EQ(image.width, size.x);
        EXPECT_EQ(image.height, size.y);
        EXPECT_EQ(image.channels.at("R").pixels.size(), pixel_count(image));
        for (const float pixel : image.channels.at("sampleCount.Y").pixels)
            ASSERT_EQ(pixel, 1.0f);
    }
}

// Rows of groups one pixel high would pass the limit of 65,535.
TEST(HardCase, row39_longest_column_renders_with_groups_one_row_high) {
    RenderOptions options;
    options.executor.group_size = {32, 1};
    EXPECT_EQ(test::render_validated(one_voxel({1, 131072}), options).image.height, 131072);
}

TEST(HardCase, row39_longest_row_renders) {
    EXPECT_EQ(test::render_validated(one_voxel({131072, 1})).image.width, 131072);
}

// Film 8-byte sums, 6 of them a pixel: 12 GiB. It splits into film tiles below every limit of one buffer, and
// is refused by a budget of memory, not by the device.
TEST(HardCase, row39_plan_of_16384_squared_splits_into_bands_or_is_refused_by_the_budget) {
    const Scene scene = one_voxel({16384, 16384});
    const DeviceLimits limits;
    const RenderPlan plan = prepare_scene(scene, {}, limits).plan;
    EXPECT_GE(std::uint64_t{plan.film_tile_rows} * plan.film_tile_count, 16384u);
    const Footprint needs = footprint(plan);
    for (const PlannedBuffer& planned : needs.buffers)
        EXPECT_LE(planned.bytes, limits.max_binding_bytes) << planned.buffer;
    try {
        (void)prepare_scene(scene, {.memory_budget_bytes = std::uint64_t{4} << 30}, limits);
        ADD_FAILURE() << "not refused";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::out_of_memory);
    }
}

TEST(HardCase, row39_sides_of_zero_or_beyond_the_file_formats_are_refused) {
    for (const glm::ivec2 size : {glm::ivec2(0, 5), {5, 0}, {-1, 5}, {131073, 1}, {1, 600000}, {600000, 1}}) {
        try {
            (void)prepare_scene(one_voxel(size), {}, {});
            ADD_FAILURE() << size.x << "x" << size.y << " was not refused";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::input_refused);
        }
    }
}

// The binary in a process of its own, because the driver reads its number of threads once.
std::vector<std::byte> render_in_child(const std::string& environment, const std::string& flags) {
    const fs::path file = fs::path(testing::TempDir()) / "voxilux_row24.exr";
    const std::string command = environment + " " + VX_BINARY + " render " + VX_SOURCE_DIR +
                                "/scenes/mixed.toml --size 72x40 --spp 3 --reproducible --no-cache -q -o " +
                                file.string() + " " + flags;
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
    std::vector<std::byte> bytes = read_file(file);
    fs::remove(file);
    return bytes;
}

TEST(HardCase, row24_picture_is_the_same_with_no_one_and_two_threads_and_any_groups) {
    const std::vector<std::byte> two = render_in_child("LP_NUM_THREADS=2", "");
    EXPECT_EQ(render_in_child("LP_NUM_THREADS=0", ""), two);
    EXPECT_EQ(render_in_child("LP_NUM_THREADS=1", ""), two);
    EXPECT_EQ(render_in_child("LP_NUM_THREADS=2", "--group-size 16x16"), two);
    EXPECT_NE(render_in_child("LP_NUM_THREADS=2", "--seed 5"), two);
}

}  // namespace
}  // namespace voxilux
