// Hard cases of the occlusion hash, numbered as in README.md: rows of cases and holes of earlier renderers.
// Others are beside what they test (tests/shaders/cell_table_test.cpp, tests/device/pass/ao_value_test.cpp).

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "support/ao_fixture.h"
#include "support/frame_fixture.h"
#include "support/occlusion_forms.h"
#include "support/test_scenes.h"

namespace voxilux {
namespace {

using test::AoFixture;
using test::AoFrame;
using test::CellSums;

std::vector<float> brute_visibility(Scene scene) {
    scene.settings.ao.method = AoMethod::brute;
    return test::FrameFixture(scene).render(0).ao;
}

TEST(HardCase, row19_pixels_without_a_slot_have_the_visibility_of_brute_force_and_are_counted) {
    for (const std::uint32_t slots : {1u, 2u, 16u}) {
        Scene scene = test::pillared_scene();
        scene.settings.ao.slots = slots;
        scene.settings.ao_rays = 8;
        const AoFrame frame = AoFixture(scene).render();
        const std::vector<float> brute = brute_visibility(scene);
        std::uint64_t own = 0;
        for (std::size_t i = 0; i < brute.size(); ++i) {
            if (frame.hits[i].face >= gpu::kFaceInside || frame.slot_of(i)) continue;
            ++own;
            ASSERT_EQ(frame.visibility[i], brute[i]) << i;
        }
        EXPECT_GT(own, 1000u);
        EXPECT_EQ(frame.counters[gpu::kFaultAoTableFull], own);
        EXPECT_EQ(frame.counters[gpu::kWorkAoOwnRays], 8 * own);
        EXPECT_LE(frame.counters[gpu::kWorkAoProbes],
                  2 * gpu::kCellProbes * frame.counters[gpu::kWorkAoSearches]);
        EXPECT_EQ(test::sums_of(frame).size(), slots);
    }
}

TEST(HardCase, row19_comparison_rejects_the_visibility_of_another_seed) {
    Scene scene = test::pillared_scene();
    const std::vector<float> brute = brute_visibility(scene);
    scene.settings.seed = 99;
    EXPECT_NE(brute, brute_visibility(scene));
}

TEST(HardCase, row19_all_pixels_of_one_key_share_one_cell) {
    Scene scene = test::pillared_scene();
    scene.camera = test::camera_down({8.3, -2.7, 30.0}, 0.3);
    scene.settings.ao.cell_px = 4096.0f;
    AoFixture fixture(scene);
    const AoFrame frame = fixture.render();
    EXPECT_EQ(frame.counters[gpu::kWorkAoClaimed], 1u);
    const CellSums sums = test::sums_of(frame);
    ASSERT_EQ(sums.size(), 1u);
    EXPECT_EQ(sums.begin()->second.first, std::uint64_t{scene.settings.ao_rays} * frame.hits.size());
    EXPECT_EQ(std::set<float>(frame.visibility.begin(), frame.visibility.end()).size(), 1u);
}

// Compares every pixel's key with double precision; false when a face has none.
void expect_right_keys(const AoFixture& fixture, const AoFrame& frame, std::size_t at_least) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < frame.hits.size(); ++i) {
        if (frame.hits[i].face >= gpu::kFaceInside) continue;
        ++count;
        const auto slot = frame.slot_of(i);
        ASSERT_TRUE(slot) << i;
        ASSERT_EQ(test::key_disagreement(fixture, frame, frame.hits[i], frame.keys[*slot]), "") << i;
    }
    EXPECT_GE(count, at_least);
}

TEST(HardCase, row20_camera_a_million_voxels_away_finds_the_cells_of_double_precision) {
    for (const double fov : {1e-3, 1e-4, 1e-5}) {
        Scene scene = test::pillared_scene();
        scene.camera = test::camera_towards({6e5, 5e5, 6e5}, {1, 2, 1}, fov);
        AoFixture fixture(scene);
        for (std::uint32_t i = 0; i < 3; ++i)
            expect_right_keys(fixture, fixture.render(i), 1000);
    }
}

TEST(HardCase, row20_scene_a_million_voxels_from_the_origin_has_the_cells_of_the_one_at_it) {
    const glm::ivec3 far(1048576, -1048576, 999984);  // whole chunks of 16^3
    Scene near = test::pillared_scene();
    Scene moved = near;
    for (Instance& instance : moved.instances)
        instance.translation += far;
    moved.camera->position += glm::dvec3(far);
    AoFixture near_rig(near);
    const CellSums sums = test::sums_of(near_rig.render());
    const glm::ivec3 origin = near_rig.march_world().origin;
    AoFixture moved_rig(moved);
    ASSERT_EQ(moved_rig.march_world().origin, origin + far);
    EXPECT_TRUE(test::sums_of(moved_rig.render()) == sums);
}

// A dolly shot through many distances: every hit is in a cell of the level that its distance calls for.
TEST(HardCase, row20_levels_follow_the_distance_within_their_bounds) {
    Scene scene = test::pillared_scene();
    scene.settings.ao.cell_px = 4.0f;
    AoFixture fixture(scene);
    std::set<std::uint32_t> levels;
    for (const double distance : {300.0, 90.0, 40.0, 20.0, 10.0, 5.0, 2.0, 0.6}) {
        const AoFrame frame =
            fixture.render(test::camera_towards({12.0 - distance, 0.3, 0.7 * distance}, {12, 0, 0}, 50));
        expect_right_keys(fixture, frame, 5);
        for (const auto& [key, sum] : test::sums_of(frame))
            levels.insert(test::cell_of_key(key).value().level);
    }
    EXPECT_EQ(levels, (std::set<std::uint32_t>{0, 1, 2, 3, 4}));
}

// The camera is close to a wall: cells do not get smaller without end.
TEST(HardCase, hole13_camera_close_to_a_wall_enters_few_cells) {
    Scene scene = test::pillared_scene();
    scene.camera = test::camera_towards({-5.43, 4.999, 2.37}, {-5.43, 6.0, 2.37}, 60.0);
    const AoFrame frame = AoFixture(scene).render();
    EXPECT_EQ(frame.counters[gpu::kWorkHits], frame.hits.size());
    EXPECT_LE(frame.counters[gpu::kWorkAoClaimed], 9u) << "the picture is two thousandths of a voxel wide";
}

// Sums after one more frame, on top of other sums that were put into the table.
void expect_sums_carry_on(std::uint64_t preset) {
    AoFixture fixture(test::pillared_scene());
    AoFrame before = fixture.render();
    for (std::size_t slot = 0; slot < before.keys.size(); ++slot) {
        if (before.keys[slot] == 0) continue;
        before.samples[slot] = preset;
        before.opens[slot] = preset - preset / 3;
    }
    fixture.set_sums(before.samples, before.opens);
    const AoFrame after = fixture.render();
    std::uint64_t taken = 0;
    for (std::size_t slot = 0; slot < before.keys.size(); ++slot) {
        ASSERT_EQ(after.keys[slot], before.keys[slot]);
        if (after.keys[slot] == 0) continue;
        const std::uint64_t more = after.samples[slot] - preset;
        taken += more;
        ASSERT_LE(more, 5000u);
        ASSERT_EQ(after.opens[slot] - before.opens[slot],
                  test::open_samples(fixture, after.keys[slot], preset, preset + more))
            << "the samples are numbered on from " << preset;
    }
    EXPECT_EQ(taken, after.counters[gpu::kWorkAoRays]);
    for (std::size_t i = 0; i < after.hits.size(); ++i) {
        const auto slot = after.slot_of(i);
        if (!slot) continue;
        const double share =
            static_cast<double>(after.opens[*slot]) / static_cast<double>(after.samples[*slot]);
        ASSERT_NEAR(static_cast<double>(after.visibility[i]), share, 2e-7);
    }
}

TEST(HardCase, row21_sums_carry_on_past_the_end_of_every_counter_width) {
    for (const std::uint64_t preset : {65534ull, 65535ull, 65536ull, (1ull << 24) - 1, (1ull << 24) + 1,
                                       (1ull << 32) - 3, (1ull << 32) - 1, 1ull << 32, 1ull << 53})
        expect_sums_carry_on(preset);
}

TEST(HardCase, row22_visibility_of_a_plane_stays_one_for_any_number_of_samples) {
    Scene scene = test::white_scene();
    test::add_box(scene, {-40, -40, -1}, {40, 40, 0});
    scene.camera = test::camera_down({0.5, 0.5, 20.0}, 30.0);
    scene.settings.size = {24, 16};
    for (const std::uint32_t filter : {0u, 2u}) {
        scene.settings.ao.filter = filter;
        AoFixture fixture(scene);
        AoFrame frame = fixture.render();
        for (const std::uint64_t count :
             {65535ull, (1ull << 24) + 1, (1ull << 32) - 1, 1ull << 53, 1ull << 63}) {
            for (std::size_t slot = 0; slot < frame.keys.size(); ++slot)
                frame.samples[slot] = frame.keys[slot] == 0 ? 0 : count;
            fixture.set_sums(frame.samples, frame.samples);
            frame = fixture.render();
            for (const float visibility : frame.visibility)
                ASSERT_EQ(visibility, 1.0f) << count << " filter " << filter;
        }
    }
}

// 70,000 samples in one cell, added by rays alone.
TEST(HardCase, hole05_samples_beyond_65536_in_one_cell_are_all_there) {
    Scene scene = test::pillared_scene();
    scene.camera = test::camera_down({8.3, -2.7, 30.0}, 0.3);
    scene.settings.ao_rays = 16;
    scene.settings.ao.cell_px = 4096.0f;
    AoFixture fixture(scene);
    AoFrame frame;
    for (int i = 0; i < 2; ++i)
        frame = fixture.render();
    const CellSums sums = test::sums_of(frame);
    ASSERT_EQ(sums.size(), 1u);
    const auto& [key, sum] = *sums.begin();
    EXPECT_EQ(sum.first, 2u * 16u * 64u * 36u);
    EXPECT_GT(sum.first, 70000u);
    EXPECT_EQ(sum.second, test::open_samples(fixture, key, 0, sum.first));
}

// Sums after some frames from a given state.
CellSums flight_from(std::uint64_t frames_done, int frames) {
    AoFixture fixture(test::pillared_scene());
    fixture.state.frames_done = frames_done;
    CellSums sums;
    for (int i = 0; i < frames; ++i)
        sums = test::sums_of(fixture.render(test::flying_camera(i)));
    return sums;
}

TEST(HardCase, row23_frame_numbers_that_wrap_change_nothing) {
    const CellSums plain = flight_from(0, 12);
    for (const std::uint64_t first : {0xFFFFFFFAull, 0xFFFFFFFFull, 0x1FFFFFFF8ull, 0x7FFFFFFCull})
        EXPECT_TRUE(flight_from(first, 12) == plain) << first;
}

TEST(HardCase, row23_cells_in_sight_outlive_the_wrap_of_frame_numbers) {
    AoFixture fixture(test::pillared_scene());
    fixture.state.frames_done = 0xFFFFFFFFu - 50;
    for (int i = 0; i < 100; ++i)
        ASSERT_EQ(fixture.render().counters[gpu::kWorkAoEvicted], 0u) << i;
}

// Cells that come back into sight just before they would be given up are kept.
TEST(HardCase, hole16_cells_seen_again_are_not_given_up_while_in_sight) {
    for (int away = 28; away <= 42; ++away) {
        AoFixture fixture(test::pillared_scene());
        (void)fixture.render();
        const Camera sky = test::camera_towards({0, 0, 20}, {0, 0.1, 40}, 30.0);
        for (int i = 0; i < away; ++i)
            (void)fixture.render(sky);
        (void)fixture.render();
        for (int i = 0; i < 12; ++i)
            ASSERT_EQ(fixture.render().counters[gpu::kWorkAoEvicted], 0u)
                << i << " frames after " << away << " away";
    }
}

TEST(HardCase, row23_wrap_of_the_number_of_samples_loses_none) {
    AoFixture fixture(test::pillared_scene());
    (void)fixture.render();
    fixture.state.samples_done = 0xFFFFFFFFu;
    std::uint64_t traced = 0;
    CellSums sums;
    for (int i = 0; i < 4; ++i) {
        const AoFrame frame = fixture.render();
        traced += frame.counters[gpu::kWorkAoRays];
        sums = test::sums_of(frame);
    }
    std::uint64_t samples = 0;
    for (const auto& [key, sum] : sums)
        samples += sum.first;
    EXPECT_EQ(samples, 5 * traced / 4);
}

TEST(HardCase, row23_seeds_at_the_ends_give_other_sums) {
    std::set<std::vector<float>> pictures;
    for (const std::uint32_t seed : {0u, 1u, 0x7FFFFFFFu, 0x80000000u, 0xFFFFFFFEu, 0xFFFFFFFFu}) {
        Scene scene = test::pillared_scene();
        scene.settings.seed = seed;
        pictures.insert(AoFixture(scene).render().visibility);
    }
    EXPECT_EQ(pictures.size(), 6u);
}

// Root mean square error of some cells in front of a wall after so many samples.
double error_after(const AoFixture& fixture, std::uint64_t samples) {
    double sum = 0.0;
    constexpr int kCells = 8;
    for (int i = 0; i < kCells; ++i) {
        const glm::ivec3 voxel = glm::ivec3(2, 3 * i, -1) - fixture.march_world().origin;
        const std::uint64_t key = test::key_of({voxel, 5u, 2u, {1u, 2u}});
        double blocked = 0.0;
        for (int j = 0; j < 8; ++j)
            blocked += test::blocked_by_wall(2.0 - (1.0 + (j + 0.5) / 8.0) / 4.0, 5.0, 12.0) / 8.0;
        const double open = static_cast<double>(test::open_samples(fixture, key, 0, samples));
        const double error = open / static_cast<double>(samples) - (1.0 - blocked);
        sum += error * error / kCells;
    }
    return std::sqrt(sum);
}

TEST(HardCase, hole15_error_of_a_cell_falls_on_to_65536_samples) {
    Scene scene = test::white_scene();
    test::add_box(scene, {-16, -40, -1}, {16, 60, 0});
    test::add_box(scene, {4, -40, 0}, {5, 60, 5});
    scene.settings.ao_radius = 12.0f;
    const AoFixture fixture(scene);
    double last = error_after(fixture, 64);
    for (const std::uint64_t samples : {1024u, 16384u, 65536u}) {
        const double error = error_after(fixture, samples);
        testing::Test::RecordProperty("rmse_" + std::to_string(samples), std::to_string(error));
        const double white = std::sqrt(0.25 / static_cast<double>(samples));
        EXPECT_LT(error, 0.5 * white) << samples << ": better than white noise";
        EXPECT_LT(error, last) << samples;
        last = error;
    }
}

}  // namespace
}  // namespace voxilux
