// The numbers, the variants, the motions and the rows of `bench ao`.

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "base/error.h"
#include "base/median.h"
#include "jobs/bench/ao_motion.h"
#include "jobs/bench/ao_numbers.h"
#include "jobs/bench/ao_row.h"
#include "jobs/bench/ao_variant.h"
#include "scene/scene_camera.h"

namespace voxilux {
namespace {

constexpr double kRoundings = 1e-6;  // of some floats of order one

const AoReference kReference{.pixels = {1, 3}, .visibility = {0.25f, 0.5f}};

TEST(AoNumbers, rmse_is_the_root_of_the_mean_square_over_the_reference) {
    const std::vector<float> visibility = {9.0f, 0.5f, 9.0f, 1.0f};
    EXPECT_NEAR(rmse_over(kReference, visibility), std::sqrt((0.0625 + 0.25) / 2.0), kRoundings);
}

TEST(AoNumbers, rmse_sees_each_pixel_of_the_reference_and_no_other) {
    const std::vector<float> equal = {9.0f, 0.25f, 9.0f, 0.5f};
    EXPECT_EQ(rmse_over(kReference, equal), 0.0);
    for (std::size_t i = 0; i < equal.size(); ++i) {
        std::vector<float> perturbed = equal;
        perturbed[i] += 0.1f;
        EXPECT_EQ(rmse_over(kReference, perturbed) > 0.0, i == 1 || i == 3) << i;
    }
    EXPECT_EQ(rmse_over({}, equal), 0.0);
}

TEST(AoNumbers, change_is_the_mean_over_the_pixels_in_either_direction) {
    const std::vector<float> before = {0.0f, 0.5f, 0.0f, 0.5f};
    const std::vector<float> after = {1.0f, 0.75f, 1.0f, 0.25f};
    EXPECT_NEAR(mean_change(before, after, kReference.pixels), 0.25, kRoundings);
    EXPECT_EQ(mean_change(before, before, kReference.pixels), 0.0);
    EXPECT_EQ(mean_change(before, after, {}), 0.0);
}

TEST(AoNumbers, noise_of_a_reference_is_that_of_a_coin_thrown_so_often) {
    const AoReference coin{.pixels = {0}, .visibility = {0.5f}};
    EXPECT_NEAR(noise_bound(coin, 100), 0.05, kRoundings);
    EXPECT_NEAR(noise_bound(coin, 400), 0.025, kRoundings);
    const AoReference certain{.pixels = {0, 1}, .visibility = {0.0f, 1.0f}};
    EXPECT_EQ(noise_bound(certain, 1), 0.0);
    EXPECT_EQ(noise_bound({}, 1), 0.0);
}

// Two frames: 100 samples of 4 rays each, 20 of them without a cell; 10 keys swapped in the first frame.
AoWork two_frames() {
    AoWork work;
    for (const gpu::uint swaps : {10u, 0u}) {
        std::array<gpu::uint, gpu::kCounterCount> counters{};
        counters[gpu::kWorkAoRays] = 400;
        counters[gpu::kWorkAoOwnRays] = 80;
        counters[gpu::kWorkAoSwaps] = swaps;
        counters[gpu::kWorkAoSearches] = 25;
        counters[gpu::kWorkAoReused] = 75;
        counters[gpu::kWorkAoProbes] = 50;
        work.add(counters);
    }
    return work;
}

TEST(AoNumbers, atomics_are_the_swaps_and_two_for_each_sample_of_a_cell) {
    EXPECT_EQ(atomics_per_frame(two_frames(), 4), 5.0 + 2.0 * 80.0);
    EXPECT_EQ(atomics_per_frame({}, 4), 0.0);
}

TEST(AoNumbers, atomics_change_with_each_count_that_they_depend_on) {
    for (std::size_t i = 0; i < gpu::kCounterCount; ++i) {
        AoWork perturbed = two_frames();
        perturbed.counts[i] += 8;
        const bool counts = i == gpu::kWorkAoRays || i == gpu::kWorkAoOwnRays || i == gpu::kWorkAoSwaps;
        EXPECT_EQ(atomics_per_frame(perturbed, 4) != atomics_per_frame(two_frames(), 4), counts) << i;
    }
    EXPECT_NE(atomics_per_frame(two_frames(), 1), atomics_per_frame(two_frames(), 4));
}

TEST(AoNumbers, searches_are_a_share_of_the_hits_with_cells) {
    EXPECT_EQ(searched_percent(two_frames()), 25.0);
    EXPECT_EQ(probes_per_search(two_frames()), 2.0);
    AoWork perturbed = two_frames();
    perturbed.counts[gpu::kWorkAoReused] += 100;
    EXPECT_LT(searched_percent(perturbed), 25.0);
    EXPECT_EQ(searched_percent({}), 0.0);
    EXPECT_EQ(probes_per_search({}), 0.0);
}

TEST(AoNumbers, median_leaves_out_what_is_far_from_the_middle) {
    EXPECT_EQ(median({900.0, 1.0, 3.0, 2.0, 0.0}), 2.0);
    EXPECT_EQ(median({1.0, 2.0}), 1.5);
    EXPECT_EQ(median({7.0}), 7.0);
}

TEST(AoVariants, each_has_a_name_and_settings_of_its_own) {
    std::set<std::string> names;
    for (const AoVariant& variant : ao_variants()) {
        EXPECT_TRUE(names.insert(variant.name).second) << variant.name;
        for (const AoVariant& other : ao_variants()) {
            const bool is_same = variant.ao == other.ao && variant.sequence == other.sequence;
            EXPECT_EQ(is_same, variant.name == other.name) << variant.name << " " << other.name;
        }
    }
    EXPECT_TRUE(names.contains(kAoBaseline));
}

TEST(AoVariants, name_picks_one_and_an_unknown_one_is_refused) {
    EXPECT_EQ(ao_variant_named("split").ao.merged, std::optional(false));
    EXPECT_EQ(ao_variant_named("hash").ao.merged, std::nullopt);
    EXPECT_THROW((void)ao_variant_named("splti"), Error);
}

TEST(AoVariants, those_with_only_a_width_have_a_floor) {
    std::set<std::string> names;
    for (const AoVariant& variant : ao_variants())
        if (sets_only_width(variant)) names.insert(variant.name);
    EXPECT_EQ(names, (std::set<std::string>{"hash", "px-5", "px-16"}));
}

// Column and row that a camera sees a direction at, in pixels from the middle of a picture of this height.
glm::dvec2 seen_at(const Camera& camera, glm::dvec3 direction, int height) {
    const glm::dmat3 basis = camera_basis(camera);
    const double pixel = 2.0 * std::tan(glm::radians(camera.fov_y_deg) / 2.0) / height;
    const double depth = glm::dot(direction, basis[2]);
    return glm::dvec2(glm::dot(direction, basis[0]), glm::dot(direction, basis[1])) / depth / pixel;
}

TEST(AoMotions, pan_moves_the_middle_of_the_picture_by_one_pixel_a_frame) {
    for (const double pitch : {0.0, -12.0, 55.0}) {
        const Camera start{.yaw_deg = 42.0, .pitch_deg = pitch, .fov_y_deg = 42.0};
        const glm::dvec3 middle = camera_basis(start)[2];
        const glm::dvec2 second = seen_at(moved_camera(start, Motion::pan, 2, 360), middle, 360);
        EXPECT_NEAR(glm::length(second), 1.0, 0.01) << pitch;
        const glm::dvec2 third = seen_at(moved_camera(start, Motion::pan, 3, 360), middle, 360);
        EXPECT_NEAR(glm::length(third), 2.0, 0.02) << pitch;
        EXPECT_EQ(moved_camera(start, Motion::pan, 9, 360).position, start.position);
    }
}

TEST(AoMotions, walk_moves_the_camera_and_the_others_start_where_they_stay) {
    const Camera start{.position = {1.0, 2.0, 3.0}, .yaw_deg = 90.0};
    EXPECT_NEAR(glm::distance(moved_camera(start, Motion::walk, 3, 360).position,
                              start.position + glm::dvec3(2.0 * kWalkStep, 0.0, 0.0)),
                0.0, kRoundings);
    for (const Motion motion : kMotions) {
        EXPECT_EQ(moved_camera(start, motion, 1, 360).position, start.position);
        EXPECT_EQ(moved_camera(start, motion, 1, 360).yaw_deg, start.yaw_deg);
        EXPECT_EQ(motion_named(name_of(motion)), motion);
    }
    EXPECT_EQ(moved_camera(start, Motion::still, 50, 360).position, start.position);
    EXPECT_THROW((void)motion_named("run"), Error);
}

TEST(AoRows, sum_of_the_passes_and_each_error_are_in_the_table_and_in_the_json) {
    const AoRow row{.scene = "made up",
                    .motion = "still",
                    .variant = "hash",
                    .frames = 4,
                    .passes = {{"ao.lookup", 1.25}, {"ao.sample", 2.5}},
                    .errors = {{1, 0.125}, {4, 0.0625}},
                    .flicker = 0.01};
    EXPECT_EQ(row.ao_ms(), 3.75);
    const auto json = to_json(row);
    EXPECT_EQ(json["ao_ms"], 3.75);
    EXPECT_EQ(json["errors"][1]["frame"], 4);
    EXPECT_EQ(json["errors"][1]["rmse"], 0.0625);
    EXPECT_EQ(json["flicker"], 0.01);
    AoRow full = row;
    full.motion = "pan";
    full.flicker.reset();
    full.table_full = 2.5;
    EXPECT_TRUE(to_json(full)["flicker"].is_null());
    const std::string table = describe(std::vector<AoRow>{row, full});
    for (const char* part : {"made up, still: 4 frames", "made up, pan", "3.75", "0.06250", "2.550/255",
                             "rmse@4", "2.5 hits a frame find no slot"})
        EXPECT_NE(table.find(part), std::string::npos) << part << "\n" << table;
}

}  // namespace
}  // namespace voxilux
