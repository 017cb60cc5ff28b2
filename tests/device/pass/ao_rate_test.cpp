// What the occlusion hash saves: searches by reprojection, and rays by the checkerboard and by a limit of
// samples.

#include <gtest/gtest.h>

#include <algorithm>

#include "support/ao_fixture.h"
#include "support/test_scenes.h"

namespace voxilux {
namespace {

using test::AoFixture;
using test::AoFrame;

constexpr double kStillShare = 0.05;  // of the hits that may need a search, for a still camera
constexpr double kPanShare = 0.20;    // the same for a slow pan

double searched_share(const AoFrame& frame) {
    const double searches = frame.counters[gpu::kWorkAoSearches];
    return searches / (searches + frame.counters[gpu::kWorkAoReused]);
}

Scene rate_scene(bool reproject) {
    Scene scene = test::pillared_scene();
    scene.settings.size = {160, 90};
    scene.camera->fov_y_deg =
        14.0;  // cells of half a voxel and less, so that they are as wide as is wished for
    scene.settings.ao.cell_px = 10.0f;
    scene.settings.ao.reproject = reproject;
    return scene;
}

// The camera turned by so many pixels of the picture's middle.
Camera turned(const Scene& scene, double pixels) {
    Camera camera = *scene.camera;
    const double half_height = std::tan(camera.fov_y_deg * 3.14159265358979 / 360.0);
    camera.yaw_deg += pixels * 180.0 / 3.14159265358979 * 2.0 * half_height / scene.settings.size.y;
    return camera;
}

// The largest fraction of hits searched in a frame after the first.
double worst_share(AoFixture& fixture, double pixels_a_frame, bool same_points) {
    double worst = 0.0;
    for (int i = 0; i < 30; ++i) {
        const auto sample = static_cast<std::uint32_t>(same_points ? 0 : i);
        const AoFrame frame = fixture.render(turned(fixture.scene(), pixels_a_frame * i), sample);
        if (i > 0) worst = std::max(worst, searched_share(frame));
    }
    return worst;
}

TEST(AoRate, still_camera_searches_few_cells_after_its_first_frame) {
    for (const bool same_points : {true, false}) {
        AoFixture fixture(rate_scene(true));
        const double worst = worst_share(fixture, 0.0, same_points);
        EXPECT_LE(worst, same_points ? 0.0 : kStillShare);
        testing::Test::RecordProperty(same_points ? "same_points" : "other_points", std::to_string(worst));
    }
}

TEST(AoRate, slow_pan_searches_few_cells) {
    for (const double pixels : {0.3, 1.0, 1.5}) {
        AoFixture fixture(rate_scene(true));
        const double worst = worst_share(fixture, pixels, false);
        EXPECT_LE(worst, kPanShare);
        testing::Test::RecordProperty("pan_" + std::to_string(static_cast<int>(10 * pixels)),
                                      std::to_string(worst));
    }
}

TEST(AoRate, comparison_rejects_searches_of_every_hit) {
    AoFixture fixture(rate_scene(false));
    EXPECT_EQ(worst_share(fixture, 0.0, true), 1.0);
}

TEST(AoRate, change_of_the_world_or_a_camera_elsewhere_searches_again) {
    AoFixture fixture(rate_scene(true));
    (void)fixture.render();
    EXPECT_EQ(searched_share(fixture.render()), 0.0);
    Camera behind = *fixture.scene().camera;
    behind.yaw_deg += 180.0;
    behind.pitch_deg -= 30.0;
    const AoFrame away = fixture.render(behind);
    EXPECT_TRUE(away.counters[gpu::kWorkAoReused] == 0u);
    EXPECT_EQ(searched_share(fixture.render()), 1.0) << "the last frame saw other places";
    fixture.state.change_world();
    const AoFrame anew = fixture.render();
    EXPECT_EQ(searched_share(anew), 1.0);
    EXPECT_EQ(anew.counters[gpu::kWorkAoClaimed], test::sums_of(anew).size()) << "the table was emptied";
}

TEST(AoRate, checkerboard_traces_every_other_pixel_after_the_first_frame) {
    Scene scene = rate_scene(true);
    scene.settings.ao.checkerboard = true;
    AoFixture fixture(scene);
    const auto width = static_cast<std::size_t>(scene.settings.size.x);
    for (std::uint32_t i = 0; i < 6; ++i) {
        const AoFrame frame = fixture.render();
        std::uint64_t pixels = 0;
        for (std::size_t pixel = 0; pixel < frame.hits.size(); ++pixel) {
            const bool turn = i == 0 || (pixel % width + pixel / width + i) % 2 == 0;
            pixels += frame.hits[pixel].face < gpu::kFaceInside && turn ? 1 : 0;
        }
        EXPECT_EQ(frame.counters[gpu::kWorkAoRays], pixels * scene.settings.ao_rays) << i;
    }
}

TEST(AoRate, cells_with_enough_samples_take_no_more_and_are_kept) {
    Scene scene = rate_scene(true);
    scene.settings.ao.sample_limit = 100;
    scene.settings.ao_rays = 8;
    AoFixture fixture(scene);
    AoFrame full;
    int frames = 0;
    do {
        full = fixture.render();
    } while (full.counters[gpu::kWorkAoRays] > 0 && ++frames < 100);
    ASSERT_EQ(full.counters[gpu::kWorkAoRays], 0u);
    for (const auto& [key, sum] : test::sums_of(full))
        ASSERT_GE(sum.first, 100u);
    for (int i = 0; i < 100; ++i) {
        const AoFrame frame = fixture.render();
        ASSERT_EQ(frame.counters[gpu::kWorkAoRays], 0u);
        ASSERT_EQ(frame.counters[gpu::kWorkAoEvicted], 0u);
        ASSERT_EQ(frame.visibility, full.visibility);
    }
}

// A pixel that takes no samples still keeps its cell.
TEST(AoRate, no_key_is_swapped_when_cells_are_found_by_reprojection) {
    AoFixture fixture(rate_scene(true));
    (void)fixture.render();
    const AoFrame frame = fixture.render();
    EXPECT_GT(frame.counters[gpu::kWorkAoReused], 0u);
    EXPECT_EQ(frame.counters[gpu::kWorkAoSearches], 0u);
    EXPECT_EQ(frame.counters[gpu::kWorkAoSwaps], 0u);
}

}  // namespace
}  // namespace voxilux
