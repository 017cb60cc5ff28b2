// Visibility of cells with many samples against closed forms (support/occlusion_forms.h). A cell's truth is
// the mean of the form over its square, because its samples start everywhere in it. With white noise the
// counts are binomial.

#include <gtest/gtest.h>

#include <functional>
#include <map>

#include "support/ao_fixture.h"
#include "support/occlusion_forms.h"
#include "support/test_scenes.h"

namespace voxilux {
namespace {

using test::AoFixture;
using test::AoFrame;

// Standard deviations. All cells of a picture together may stray by this much (1 in 16,000), and one of
// hundreds by more. The seeds are fixed, so what passes once stays so.
constexpr double kWholeSigmas = 4.0;
constexpr double kCellSigmas = 5.0;
// Below this variance of a count the binomial is not normal enough for a test of one cell.
constexpr double kNormalVariance = 9.0;

constexpr float kRadius = 16.0f;

// A floor of top z = 0 in a square that no ray of kRadius leaves when it starts within 8 voxels of the
// middle.
Scene floor_scene() {
    Scene scene = test::white_scene();
    test::add_box(scene, {-26, -26, -1}, {26, 26, 0});
    scene.settings.size = {20, 20};
    scene.settings.ao_rays = 64;
    scene.settings.ao_radius = kRadius;
    scene.settings.sequence = Sequence::white;
    scene.settings.ao.cell_px = 3.0f;
    return scene;
}

// The fraction of blocked rays at a scene position on a face; negative leaves the cell out.
using Blocked = std::function<double(glm::dvec3 position, gpu::uint face)>;

// Mean of the form over a cell, by 4 x 4 midpoints.
double blocked_in_cell(const gpu::AoCell& cell, glm::ivec3 origin, const Blocked& blocked) {
    double sum = 0.0;
    for (int i = 0; i < 16; ++i) {
        const glm::dvec2 inside((i % 4 + 0.5) / 4.0, (i / 4 + 0.5) / 4.0);
        const glm::dvec2 place =
            (glm::dvec2(cell.part) + inside) / std::ldexp(1.0, static_cast<int>(cell.level));
        glm::dvec3 position = glm::dvec3(origin + cell.voxel);
        position[static_cast<int>(cell.face / 2)] += cell.face % 2;
        position[test::axis_u(cell.face)] += place.x;
        position[test::axis_v(cell.face)] += place.y;
        const double share = blocked(position, cell.face);
        if (share < 0.0) return -1.0;
        sum += share / 16.0;
    }
    return sum;
}

struct Stray {
    double whole = 0.0;  // of all counts together, in standard deviations
    double worst_cell = 0.0;
    int cells = 0;  // compared
};

Stray compare(const Scene& scene, const Blocked& blocked, int frames = 16) {
    AoFixture fixture(scene);
    AoFrame frame;
    for (int i = 0; i < frames; ++i)
        frame = fixture.render(static_cast<std::uint32_t>(i));
    for (const float visibility : frame.visibility)
        EXPECT_TRUE(visibility >= 0.0f && visibility <= 1.0f) << visibility;
    Stray stray;
    double difference = 0.0;
    double variance = 0.0;
    for (const auto& [key, sum] : test::sums_of(frame)) {
        const double p =
            blocked_in_cell(test::cell_of_key(key).value(), fixture.march_world().origin, blocked);
        if (p < 0.0) continue;
        const double samples = static_cast<double>(sum.first);
        const double count = samples - static_cast<double>(sum.second);
        const double cell_variance = samples * p * (1.0 - p);
        ++stray.cells;
        difference += count - samples * p;
        variance += cell_variance;
        if (cell_variance > kNormalVariance)
            stray.worst_cell =
                std::max(stray.worst_cell, std::abs(count - samples * p) / std::sqrt(cell_variance));
    }
    stray.whole = difference / std::sqrt(variance);
    return stray;
}

void expect_close(const Scene& scene, const Blocked& blocked, int cells) {
    const Stray stray = compare(scene, blocked);
    EXPECT_GE(stray.cells, cells);
    EXPECT_LT(std::abs(stray.whole), kWholeSigmas);
    EXPECT_LT(stray.worst_cell, kCellSigmas);
    testing::Test::RecordProperty("whole_sigmas", std::to_string(stray.whole));
    testing::Test::RecordProperty("worst_cell_sigmas", std::to_string(stray.worst_cell));
    testing::Test::RecordProperty("cells", stray.cells);
}

// Closed forms take thousands of steps each, and many cells ask for the same.
Blocked remembered(std::function<double(double)> form, std::function<double(glm::dvec3)> argument) {
    auto known = std::make_shared<std::map<double, double>>();
    return [=](glm::dvec3 position, gpu::uint) {
        const double x = argument(position);
        if (x < 0.0) return -1.0;
        const auto [entry, is_new] = known->emplace(x, 0.0);
        if (is_new) entry->second = form(x);
        return entry->second;
    };
}

// Distance to the wall at x = 4 from places in front of it on the floor.
double before_wall(glm::dvec3 p) {
    return p.z == 0.0 && p.x < 4.0 ? 4.0 - p.x : -1.0;
}

Scene wall_scene(int height) {
    Scene scene = floor_scene();
    test::add_box(scene, {4, -26, 0}, {5, 26, height});
    scene.camera = test::camera_down({1.5, 0, 40}, 7.0);
    return scene;
}

Blocked by_low_wall(double shift) {
    return remembered([](double d) { return test::blocked_by_wall(d, 3.0, double{kRadius}); },
                      [=](glm::dvec3 p) { return before_wall(p) + (before_wall(p) < 0.0 ? 0.0 : shift); });
}

TEST(AoValue, floor_before_a_low_wall_is_the_closed_form) {
    expect_close(wall_scene(3), by_low_wall(0.0), 60);
}

TEST(AoValue, every_sequence_agrees_with_the_closed_form) {
    for (const Sequence sequence : {Sequence::sobol, Sequence::halton}) {
        Scene scene = wall_scene(3);
        scene.settings.sequence = sequence;
        const Stray stray = compare(scene, by_low_wall(0.0));
        EXPECT_LT(std::abs(stray.whole), kWholeSigmas);
        EXPECT_LT(stray.worst_cell, 1.5) << "these sequences err less than white noise";
    }
}

TEST(AoValue, comparison_rejects_a_wall_moved_by_a_tenth_of_a_voxel) {
    EXPECT_GT(std::abs(compare(wall_scene(3), by_low_wall(0.1)).whole), 2.0 * kWholeSigmas);
}

// Samples that start at the pixels instead of everywhere in a cell give the mean over the pixels, which is
// close.
TEST(AoValue, samples_by_pixel_are_near_the_closed_form) {
    Scene scene = wall_scene(3);
    scene.settings.ao.by_pixel = true;
    const Stray stray = compare(scene, by_low_wall(0.0));
    EXPECT_LT(std::abs(stray.whole), 3.0 * kWholeSigmas);
}

TEST(HardCase, row18_plane_of_cells_is_exactly_open) {
    for (const Sequence sequence : {Sequence::sobol, Sequence::halton, Sequence::white}) {
        for (const std::uint32_t filter : {0u, 1u, 2u}) {
            Scene scene = floor_scene();
            scene.settings.sequence = sequence;
            scene.settings.ao.filter = filter;
            scene.settings.ao_rays = 4;
            scene.camera = test::camera_towards({3.2, -20.0, 2.0}, {0, 0, 0}, 30.0);
            AoFixture fixture(scene);
            for (std::uint32_t i = 0; i < 4; ++i) {
                for (const float visibility : fixture.render(i).visibility)
                    ASSERT_EQ(visibility, 1.0f);
            }
        }
    }
}

// The camera is a thousandth of a voxel above the floor, so every ray grazes.
TEST(HardCase, row18_plane_of_cells_seen_at_a_grazing_angle_is_exactly_open) {
    Scene scene = test::white_scene();
    test::add_box(scene, {-200, -200, -1}, {200, 200, 0});
    scene.camera = Camera{.position = glm::dvec3(0.3, -150.0, 0.001), .yaw_deg = 90.0, .fov_y_deg = 0.01};
    scene.settings.size = {32, 32};
    scene.settings.ao_rays = 16;
    AoFixture fixture(scene);
    const AoFrame frame = fixture.render();
    EXPECT_GT(frame.counters[gpu::kWorkHits], 100u);
    for (const float visibility : frame.visibility)
        ASSERT_EQ(visibility, 1.0f);
}

TEST(HardCase, row18_floor_of_a_slit_of_cells_is_the_closed_form) {
    constexpr int kDepth = 6;
    Scene scene = floor_scene();
    test::add_box(scene, {-3, -26, 0}, {0, 26, kDepth});
    test::add_box(scene, {1, -26, 0}, {4, 26, kDepth});
    scene.camera = test::camera_down({0.5, 0.0, 40.0}, 1.3);
    const auto in_slit = [](double x) {
        return test::blocked_in_slit(x, 1.0, double{kDepth}, double{kRadius});
    };
    expect_close(scene, remembered(in_slit, [](glm::dvec3 p) { return p.z == 0.0 ? p.x : -1.0; }), 40);
}

TEST(HardCase, row18_faces_of_a_deep_corner_of_cells_are_the_closed_form) {
    Scene scene = floor_scene();
    test::add_box(scene, {-1, -1, 0}, {0, 26, 26});
    test::add_box(scene, {-1, -1, 0}, {26, 0, 26});
    scene.camera = test::camera_towards({9, 9, 9}, {0.7, 0.7, 0.7}, 16.0);
    std::map<std::pair<double, double>, double> known;
    const auto blocked = [&](glm::dvec3 p, gpu::uint face) {
        const std::pair distances(p[test::axis_u(face)], p[test::axis_v(face)]);
        const auto [entry, is_new] = known.emplace(distances, 0.0);
        if (is_new)
            entry->second = test::blocked_in_corner(distances.first, distances.second, double{kRadius});
        return entry->second;
    };
    expect_close(scene, blocked, 40);
}

// 7.5 voxels from the middle of the picture to a wall that rays leave only beyond the radius of 8.
TEST(HardCase, hole06_last_voxel_inside_the_radius_counts_for_cells) {
    Scene scene = floor_scene();
    test::add_box(scene, {8, -26, 0}, {9, 26, 26});
    scene.settings.ao_radius = 8.0f;
    scene.settings.ao_rays = 256;
    scene.camera = test::camera_down({0.53, 0.03, 40.0}, 0.2);
    const auto wall = [](double d) { return test::disc_segment(d / 8.0); };
    const Blocked blocked = remembered(wall, [](glm::dvec3 p) { return 8.0 - p.x; });
    expect_close(scene, blocked, 4);
    EXPECT_GT(std::abs(compare(scene, [](glm::dvec3, gpu::uint) { return 1e-9; }).whole), kWholeSigmas)
        << "as if the wall were beyond the radius";
}

// Two rooms with one floor and a wall of one voxel between them. One is closed; the other has no roof and no
// other walls.
Scene two_rooms() {
    Scene scene = floor_scene();
    test::add_box(scene, {0, -9, 0}, {1, 9, 10});     // between
    test::add_box(scene, {-10, -9, 0}, {-9, 9, 10});  // the closed room's other walls and its roof
    test::add_box(scene, {-10, -10, 0}, {1, -9, 10});
    test::add_box(scene, {-10, 9, 0}, {1, 10, 10});
    test::add_box(scene, {-10, -10, 10}, {1, 10, 11});
    scene.settings.ao_radius = 64.0f;
    return scene;
}

TEST(HardCase, hole14_cells_on_both_sides_of_a_thin_wall_never_mix) {
    AoFixture fixture(two_rooms());
    const Camera inside = test::camera_towards({-3.0, 0.2, 4.0}, {-0.3, 0.0, 0.0}, 70.0);
    const Camera outside = test::camera_towards({4.0, 0.2, 4.0}, {1.3, 0.0, 0.0}, 70.0);
    for (std::uint32_t i = 0; i < 12; ++i) {
        const AoFrame dark = fixture.render(inside, i);
        for (const float visibility : dark.visibility)
            ASSERT_EQ(visibility, 0.0f);
        const AoFrame light = fixture.render(outside, i);
        int beside = 0;
        for (std::size_t pixel = 0; pixel < light.hits.size(); ++pixel) {
            const gpu::Hit& hit = light.hits[pixel];
            const int x = fixture.march_world().origin.x + hit.cell.x;
            if (hit.face != 5u || x != 1) continue;
            ++beside;
            ASSERT_GT(light.visibility[pixel], 0.25f) << "half is blocked at the wall";
            ASSERT_LT(light.visibility[pixel], 0.85f);
        }
        EXPECT_GT(beside, 5);
    }
}

TEST(HardCase, hole14_open_side_of_the_thin_wall_is_the_closed_form) {
    Scene scene = two_rooms();
    scene.settings.ao_radius = 8.0f;
    scene.camera = test::camera_down({2.5, 0.0, 40.0}, 6.0);
    const auto wall = [](double d) { return test::blocked_by_wall(d, 10.0, 8.0); };
    expect_close(
        scene, remembered(wall, [](glm::dvec3 p) { return p.z == 0.0 && p.x > 1.0 ? p.x - 1.0 : -1.0; }), 25);
}

}  // namespace
}  // namespace voxilux
