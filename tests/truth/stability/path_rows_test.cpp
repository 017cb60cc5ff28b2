// Rows P4 to P17 and D1 to D8 of the list of hard cases: light found by paths.

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "formats/scene_toml.h"
#include "scene/technique_choice.h"
#include "shared/counters.h"
#include "support/frame_fixture.h"
#include "support/light_pictures.h"
#include "support/light_scenes.h"
#include "support/shared_data.h"

namespace voxilux {
namespace {

using test::FramePlanes;
using test::LightPicture;

Scene traced(Scene scene, const char* technique = "paths") {
    choose_technique("indirect", technique, scene.settings);
    if (std::string_view(technique) == "paths") choose_technique("caustics", "paths", scene.settings);
    return scene;
}

LightPicture render(const Scene& scene, std::uint32_t samples, int block, const char* technique = "paths") {
    const std::array blocks{block};
    return test::render_light(traced(scene, technique), {samples, blocks, {}}).front();
}

std::vector<glm::vec3> colours_of(const Scene& scene, std::uint32_t samples = 4) {
    test::FrameFixture fixture(scene, PlanRequest{});
    std::vector<glm::vec3> colours;
    for (std::uint32_t sample = 0; sample < samples; ++sample) {
        const std::vector<glm::vec3> more = fixture.render(sample).color;
        colours.insert(colours.end(), more.begin(), more.end());
    }
    return colours;
}

double farthest_apart(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b) {
    EXPECT_EQ(a.size(), b.size());
    double most = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        for (int c = 0; c < 3; ++c)
            most = std::max(most, std::abs(double{a[i][c]} - double{b[i][c]}));
    return most;
}

// Walls and blocks with a window to the sky.
Scene court() {
    Scene scene = test::dark_scene(32, 1024, 1.0);
    const std::uint16_t stone = test::add_material(scene, {.albedo = {0.7f, 0.5f, 0.3f}});
    test::add_box(scene, {-8, -8, -1}, {8, 8, 0}, stone);
    test::add_box(scene, {4, -8, 0}, {5, 8, 9}, stone);
    test::add_box(scene, {-5, 1, 0}, {-2, 4, 4}, test::add_diffuse(scene, 0.9f));
    scene.sky.radiance = {0.6f, 0.8f, 1.1f};
    scene.sun = {.azimuth_deg = 200.0f, .elevation_deg = 50.0f, .angular_diameter_deg = 5.0f};
    scene.camera = test::camera_towards({-9, -12, 9}, {0, 0, 1}, 50.0);
    return scene;
}

Scene lit_room(float albedo, int pixels = 24) {
    Scene scene = test::dark_scene(pixels, 1024, 1.0);
    test::add_room(scene, {10, 10, 8}, test::add_diffuse(scene, albedo));
    test::add_box(scene, {4, 4, 7}, {6, 6, 8}, test::add_emitter(scene, 12.0f));
    scene.camera = test::camera_towards({5.0, 0.4, 4.0}, {5.0, 10.0, 2.5}, 75.0);
    return scene;
}

// In a closed room of albedo 1 a path ends only at the bound, which is counted. Nothing shines there.
TEST(PathRows, p4_closed_white_room_without_an_emitter_is_black_and_ends_at_a_counted_bound) {
    Scene scene = test::dark_scene(8, 1024, 1.0);
    scene.sky.radiance = glm::vec3(1.0f);
    test::add_room(scene, {3, 3, 3}, test::add_diffuse(scene, 1.0f));
    scene.camera = test::camera_towards({1.5, 0.5, 1.5}, {1.5, 3.0, 1.0}, 70.0);
    test::FrameFixture fixture(traced(scene), PlanRequest{});
    const FramePlanes planes = fixture.render(0);
    for (const glm::vec3& colour : planes.color)
        ASSERT_EQ(colour, glm::vec3(0.0f));
    EXPECT_GT(planes.counters[gpu::kFaultPathTooLong], 0u);
    EXPECT_EQ(planes.counters[gpu::kFaultLoopCut], 0u);
}

TEST(PathRows, p5_black_surfaces_and_black_channels_send_nothing_on) {
    Scene scene = lit_room(0.0f);
    Scene alone = scene;
    choose_technique("indirect", "none", alone.settings);
    EXPECT_EQ(colours_of(traced(scene)), colours_of(alone));
    for (Scene* one : {&scene, &alone})
        one->materials[0].albedo = {0.0f, 0.5f, 0.0f};
    const std::vector<glm::vec3> green = colours_of(traced(scene)), direct = colours_of(alone);
    double more = 0.0;
    for (std::size_t i = 0; i < green.size(); ++i) {
        ASSERT_EQ(green[i].x, direct[i].x);
        ASSERT_EQ(green[i].z, direct[i].z);
        more += double{green[i].y} - double{direct[i].y};
    }
    EXPECT_GT(more, 0.0);
}

TEST(PathRows, p7_sun_that_sets_behind_a_face_dims_as_its_disc_does) {
    Scene scene = court();
    scene.sky.radiance = glm::vec3(0.0f);
    scene.sun.angular_diameter_deg = 8.0f;
    scene.sun.azimuth_deg = 90.0f;
    double last = 0.0;
    for (const float elevation : {1.0f, 2.0f, 4.0f, 8.0f}) {
        scene.sun.elevation_deg = elevation;
        const LightPicture picture = render(scene, 32, 32);
        EXPECT_GT(picture.pixels[0].mean.x, last) << elevation;
        last = picture.pixels[0].mean.x;
    }
}

TEST(PathRows, p8_sky_and_sun_together_are_the_sum_of_both_in_every_sample) {
    const Scene both = court();
    Scene sky = both, sun = both;
    sky.sun.on = false;
    sun.sky.radiance = glm::vec3(0.0f);
    const std::vector<glm::vec3> a = colours_of(traced(sky)), b = colours_of(traced(sun));
    std::vector<glm::vec3> sum(a.size());
    for (std::size_t i = 0; i < a.size(); ++i)
        sum[i] = a[i] + b[i];
    EXPECT_LT(farthest_apart(colours_of(traced(both)), sum), 1e-5);
    EXPECT_GT(farthest_apart(colours_of(traced(both)), a), 0.1) << "the negative control: the sky alone";
}

// A bright room beside a dark one, with one voxel of wall between them.
TEST(PathRows, p11_dark_room_behind_a_wall_of_one_voxel_stays_exactly_black) {
    Scene scene = lit_room(0.8f);
    test::add_box(scene, {-1, 5, 0}, {11, 6, 8}, test::add_diffuse(scene, 0.8f));
    scene.camera = test::camera_towards({5.0, 9.5, 4.0}, {5.0, 5.0, 2.5}, 75.0);
    for (const glm::vec3& colour : colours_of(traced(scene)))
        ASSERT_EQ(colour, glm::vec3(0.0f));
    test::add_box(scene, {4, 8, 7}, {5, 9, 8}, test::add_emitter(scene, 1.0f));
    EXPECT_GT(farthest_apart(colours_of(traced(scene), 1), std::vector<glm::vec3>(24u * 24u)), 0.0)
        << "the negative control: an emitter in the dark room";
}

TEST(PathRows, p14_emitters_met_by_chance_alone_give_the_same_picture) {
    Scene scene = lit_room(0.7f);
    test::add_box(scene, {2, 2, 0}, {5, 5, 3}, test::add_emitter(scene, 0.5f));
    test::expect_equal_light(render(scene, 128, 4), render(scene, 256, 4, "reference"), "reference");
}

std::vector<glm::vec3> with_groups(const Scene& scene, std::array<std::uint32_t, 2> group) {
    ExecutorOptions options;
    options.group_size = group;
    options.poison_transients = true;
    Executor executor(test_device(), all_shaders(), options);
    test::FrameFixture fixture(scene, PlanRequest{}, executor);
    return fixture.render(1).color;
}

TEST(PathRows, p17_workgroups_and_tiles_change_no_bit) {
    Scene deep = lit_room(0.995f);  // takes several rounds
    for (const Scene& scene : {traced(court()), traced(deep)}) {
        const std::vector<glm::vec3> once = with_groups(scene, {8, 8});
        EXPECT_EQ(once, with_groups(scene, {16, 16}));
        EXPECT_EQ(once, with_groups(scene, {32, 1}));
        test::FrameFixture whole(scene, PlanRequest{});
        (void)whole.render(0);
        const auto expected = whole.film_sums("beauty_a");
        test::FrameFixture again(scene, PlanRequest{});
        again.render_tile(0, 7);
        EXPECT_EQ(expected, again.film_sums("beauty_a"));
    }
}

TEST(PathRows, d1_faint_emitter_changes_the_picture_in_proportion) {
    const Scene scene = court();
    const std::vector<glm::vec3> before = colours_of(traced(scene));
    double last = 0.0;
    for (const float radiance : {1e-4f, 2e-4f, 4e-4f}) {
        Scene with_emitter = scene;
        test::add_box(with_emitter, {-2, -4, 2}, {-1, -3, 3}, test::add_emitter(with_emitter, radiance));
        Scene with_block = scene;
        test::add_box(with_block, {-2, -4, 2}, {-1, -3, 3}, test::add_diffuse(with_block, 0.0f));
        const double apart = farthest_apart(colours_of(traced(with_emitter)), colours_of(traced(with_block)));
        EXPECT_LT(apart, 2.0 * static_cast<double>(radiance));
        EXPECT_GT(apart, 1.5 * last);
        last = apart;
    }
}

TEST(PathRows, d2_emitter_made_of_two_of_half_the_area_changes_nothing) {
    const Scene one = lit_room(0.7f);
    Scene two = one;
    test::add_box(two, {4, 4, 7}, {5, 6, 8}, test::add_emitter(two, 12.0f));
    test::expect_equal_light(render(one, 64, 4), render(two, 64, 4), "halves");
    Scene brighter = one;
    test::add_box(brighter, {4, 4, 7}, {5, 6, 8}, test::add_emitter(brighter, 13.2f));
    EXPECT_FALSE(test::is_equal_light(render(one, 64, 4), render(brighter, 64, 4)))
        << "the negative control: one half a tenth brighter";
}

TEST(PathRows, d3_glass_of_index_1_under_sky_and_sun_changes_nothing) {
    const Scene bare = court();
    Scene glazed = bare;
    test::add_box(glazed, {-7, -4, 0}, {-5, 6, 6}, test::add_glass(glazed, 1.0f));
    test::expect_equal_light(render(bare, 64, 4), render(glazed, 64, 4), "clear");
    for (Material& material : glazed.materials)
        if (material.surface == Surface::glass) material.albedo = glm::vec3(0.9f);
    EXPECT_FALSE(test::is_equal_light(render(bare, 64, 4), render(glazed, 64, 4)))
        << "the negative control: glass that takes a tenth";
}

TEST(PathRows, d8_radiance_of_an_emitter_swept_from_nothing_makes_no_jump) {
    std::vector<double> means;
    for (int step = 0; step <= 8; ++step) {
        Scene scene = court();
        test::add_box(scene, {-2, -4, 2}, {-1, -3, 3},
                      test::add_emitter(scene, 0.25f * static_cast<float>(step)));
        double sum = 0.0;
        for (const glm::vec3& colour : colours_of(traced(scene)))
            sum += double{colour.x};
        means.push_back(sum);
    }
    std::vector<double> steps;
    for (std::size_t i = 1; i < means.size(); ++i)
        steps.push_back(std::abs(means[i] - means[i - 1]));
    std::vector<double> sorted = steps;
    std::ranges::sort(sorted);
    EXPECT_LT(sorted.back(), 3.0 * sorted[sorted.size() / 2]);
}

Scene fault_scene(const std::string& name) {
    Scene scene = load_scene(shared_data() / "data" / "faults" / (name + ".vox"));
    scene.settings.size = {32, 32};
    scene.camera = test::camera_towards({20, -25, 20}, {0, 0, 3}, 45.0);
    return scene;
}

TEST(PathRowsExternal, d1_light_of_a_ten_thousandth_changes_a_court_by_as_much) {
    SKIP_WITHOUT_SHARED_DATA();
    const std::vector<glm::vec3> off = colours_of(traced(fault_scene("court_off")));
    EXPECT_LT(farthest_apart(off, colours_of(traced(fault_scene("court_on")))), 1e-3);
}

TEST(PathRowsExternal, d3_block_in_glass_of_index_1_looks_like_the_bare_one) {
    SKIP_WITHOUT_SHARED_DATA();
    test::expect_equal_light(render(fault_scene("glass_none"), 64, 4),
                             render(fault_scene("glass_ior1"), 64, 4), "block");
}

}  // namespace
}  // namespace voxilux
