// Rows 25 to 36 of the list of hard cases: light, in whole pictures.

#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "formats/scene_toml.h"
#include "shared/counters.h"
#include "support/frame_fixture.h"
#include "support/light_pictures.h"
#include "support/light_scenes.h"

namespace voxilux {
namespace {

using test::LightPicture;

constexpr double kPi = std::numbers::pi;
constexpr int kBlock = 4;

Scene repository_scene(const std::string& name, int pixels) {
    Scene scene = load_scene(std::filesystem::path(VX_SOURCE_DIR) / "scenes" / (name + ".toml"));
    scene.settings.size = {pixels, pixels};
    scene.settings.photons = {.count = 16384, .radius = 0.5, .alpha = 1.0};
    return scene;
}

LightPicture render(const Scene& scene, std::uint32_t iterations, int block = kBlock,
                    const EffectRequest& effects = {}) {
    const std::array blocks{block};
    return test::render_light(scene, {iterations, blocks, effects}).front();
}

LightPicture truth_of(const Scene& scene, int spp, int block = kBlock) {
    return test::truth_picture(test::truth_world(scene),
                               {.size = scene.settings.size / block, .spp = spp, .seed = 21});
}

// Row 24. Two samples of a scene with the workgroups given.
std::vector<glm::vec3> colours_of(const Scene& scene, std::array<std::uint32_t, 2> group) {
    ExecutorOptions options;
    options.group_size = group;
    options.poison_transients = true;
    Executor executor(test_device(), all_shaders(), options);
    test::FrameFixture fixture(scene, PlanRequest{}, executor);
    std::vector<glm::vec3> colours = fixture.render(0).color;
    const std::vector<glm::vec3> more = fixture.render(1).color;
    colours.insert(colours.end(), more.begin(), more.end());
    return colours;
}

TEST(Row24Nightly, workgroups_change_no_bit_of_light) {
    for (const char* name : {"cornell", "glass_block"}) {
        const Scene scene = repository_scene(name, 40);
        const auto once = colours_of(scene, {8, 8});
        EXPECT_EQ(once, colours_of(scene, {16, 16})) << name;
        EXPECT_EQ(once, colours_of(scene, {32, 1})) << name;
    }
}

// Rays in glass that meet its surface at the critical angle, and within some units in the last place of it:
// the picture has nothing but finite radiance between 0 and n^2 times the sky's.
TEST(Row25, critical_angle_of_voxel_glass_seen_from_inside_is_sound) {
    const double critical = std::asin(1.0 / 1.5);
    for (const double fov : {1e-6, 1e-4, 1.0}) {
        Scene scene = test::dark_scene(32, 1024, 0.1);
        scene.sky.radiance = glm::vec3(1.0f);
        test::add_box(scene, {-30, -30, -2}, {30, 30, 0}, test::add_glass(scene, 1.5f));
        test::add_box(scene, {-30, -30, -3}, {30, 30, -2}, test::add_diffuse(scene, 0.0f));
        const glm::dvec3 eye(0.3, 0.4, -1.5);
        scene.camera =
            test::camera_towards(eye, eye + glm::dvec3(std::sin(critical), 0.0, std::cos(critical)), fov);
        if (fov == 1.0) scene.camera->pitch_deg += 0.3;
        test::FrameFixture fixture(scene, PlanRequest{});
        for (std::uint32_t i = 0; i < 8; ++i) {
            const test::FramePlanes planes = fixture.render(i);
            for (std::size_t f = 0; f < gpu::kFaultCount; ++f)
                ASSERT_EQ(planes.counters[f], 0u) << gpu::kCounterNames[f];
            for (const glm::vec3& colour : planes.color)
                ASSERT_TRUE(colour.x >= 0.0f && colour.x <= 2.25001f) << colour.x << ' ' << fov;
        }
    }
}

TEST(Row25, critical_angle_of_a_glass_ball_seen_from_inside_is_sound) {
    for (const double fov : {1e-6, 1e-4}) {
        Scene scene = test::dark_scene(32, 1024, 0.1);
        scene.sky.radiance = glm::vec3(1.0f);
        scene.spheres.push_back({glm::dvec3(0.0), 3.0, test::add_glass(scene, 1.5f)});
        scene.spheres.push_back({glm::dvec3(0.0), 0.1, test::add_diffuse(scene, 0.0f)});
        // Across the radius at R / n from the centre, a ray meets the surface at the critical angle. Beyond
        // that it is reflected again and again, until it meets the black sides of the picture's other half.
        scene.camera = test::camera_towards({2.0 * (1.0 - 1e-9), 0.0, 0.0}, {2.0, 5.0, 0.0}, fov);
        test::FrameFixture fixture(scene, PlanRequest{});
        const test::FramePlanes planes = fixture.render(0);
        for (const glm::vec3& colour : planes.color)
            ASSERT_TRUE(colour.x >= 0.0f && colour.x <= 2.25001f) << colour.x << ' ' << fov;
        EXPECT_EQ(planes.counters[gpu::kFaultRayUnsound], 0u);
        EXPECT_EQ(planes.counters[gpu::kFaultFilmNonFinite], 0u);
    }
}

// Row 26. Glass that neither refracts nor absorbs.
Scene clear_scene(bool has_glass) {
    Scene scene = repository_scene("cornell", 32);
    if (!has_glass) return scene;
    const std::uint16_t clear = test::add_glass(scene, 1.0f);
    scene.spheres.push_back({glm::dvec3(50.0, -90.0, 40.0), 25.0, clear});
    scene.spheres.push_back({glm::dvec3(70.0, -110.0, 30.0), 12.0, clear});
    return scene;
}

TEST(Row26Nightly, glass_of_index_1_is_invisible_as_spheres) {
    test::expect_equal_light(render(clear_scene(true), 48), render(clear_scene(false), 48), "spheres");
}

Scene voxel_room(int pixels) {
    Scene scene = test::dark_scene(pixels, 16384, 0.1);
    test::add_room(scene, {10, 10, 8}, test::add_diffuse(scene, 0.7f));
    test::add_box(scene, {4, 4, 8}, {6, 6, 9}, test::add_emitter(scene, 12.0f));
    test::add_box(scene, {7, 7, 0}, {9, 9, 4}, test::add_material(scene, {.albedo = {0.8f, 0.3f, 0.2f}}));
    scene.camera = test::camera_towards({5.0, 0.4, 4.0}, {5.0, 10.0, 2.5}, 75.0);
    return scene;
}

TEST(Row26, glass_of_index_1_is_invisible_as_voxels) {
    Scene scene = voxel_room(32);
    test::add_box(scene, {1, 3, 0}, {5, 7, 4}, test::add_glass(scene, 1.0f));
    test::expect_equal_light(render(scene, 48), render(voxel_room(32), 48), "voxels");
}

TEST(Row26, glass_that_takes_a_tenth_is_caught) {
    Scene scene = voxel_room(32);
    test::add_box(scene, {1, 3, 0}, {5, 7, 4}, test::add_glass(scene, 1.0f, 0.9f));
    EXPECT_GT(test::light_z(render(scene, 48), render(voxel_room(32), 48)).rms, test::kMaxRms);
}

TEST(Row28, voxels_alone_agree_with_paths) {
    const Scene scene = voxel_room(32);
    test::expect_equal_light(render(scene, 64), truth_of(scene, 512), "room");
}

// Two kinds of glass that touch, a solid and an emitter inside one, and a ball of glass that crosses both.
Scene media_room() {
    Scene scene = voxel_room(32);
    const std::uint16_t crown = test::add_glass(scene, 1.5f, 0.95f), flint = test::add_glass(scene, 1.8f);
    test::add_box(scene, {1, 3, 0}, {4, 7, 4}, crown);
    test::add_box(scene, {4, 3, 0}, {6, 7, 3}, flint);
    test::add_box(scene, {2, 5, 0}, {3, 6, 2}, test::add_diffuse(scene, 0.6f));
    return scene;
}

TEST(Row28, glass_that_touches_other_glass_with_a_solid_inside_agrees_with_paths) {
    const Scene scene = media_room();
    test::expect_equal_light(render(scene, 64), truth_of(scene, 1024), "touching");
}

TEST(Row28, glass_ball_that_crosses_glass_voxels_agrees_with_paths) {
    Scene scene = media_room();
    scene.spheres.push_back({glm::dvec3(4.2, 4.0, 3.2), 1.3, test::add_glass(scene, 1.3f)});
    test::expect_equal_light(render(scene, 64), truth_of(scene, 1024), "crossing");
}

// Only photons bring this light: shadow rays to the emitter end at the first surface of glass.
TEST(Row28, emitter_inside_glass_lights_what_is_in_the_same_glass) {
    Scene scene = test::dark_scene(32, 16384, 0.1);
    test::add_room(scene, {8, 8, 6}, test::add_diffuse(scene, 0.5f));
    test::add_box(scene, {2, 3, 0}, {7, 7, 4}, test::add_glass(scene, 1.5f, 0.9f));
    test::add_box(scene, {4, 5, 2}, {5, 6, 3}, test::add_emitter(scene, 10.0f));
    scene.camera = test::camera_towards({4.0, 0.4, 4.5}, {4.5, 6.0, 1.0}, 65.0);
    test::expect_equal_light(render(scene, 64), truth_of(scene, 1024), "lamp in voxels");
}

TEST(Row28, emitter_and_ball_inside_glass_balls_of_one_material_agree_with_paths) {
    Scene scene = test::dark_scene(32, 16384, 0.1);
    test::add_room(scene, {10, 10, 8}, test::add_diffuse(scene, 0.5f));
    const std::uint16_t glass = test::add_glass(scene, 1.5f, 0.95f);
    scene.spheres.push_back({glm::dvec3(4.0, 6.0, 3.0), 2.5, glass});
    scene.spheres.push_back({glm::dvec3(6.0, 6.0, 3.0), 2.5, glass});
    scene.spheres.push_back({glm::dvec3(2.6, 6.0, 3.0), 0.6, test::add_emitter(scene, 40.0f)});
    scene.spheres.push_back({glm::dvec3(7.5, 6.0, 3.0), 0.9, test::add_diffuse(scene, 0.8f)});
    scene.camera = test::camera_towards({5.0, 0.4, 4.0}, {5.0, 6.0, 2.8}, 60.0);
    test::expect_equal_light(render(scene, 64), truth_of(scene, 1024), "lamp in balls");
}

// The same medium on both sides is no surface, so the ball's own colour does not show.
TEST(Row28Nightly, glass_ball_in_voxels_of_the_same_glass_is_invisible) {
    Scene block = voxel_room(32);
    const std::uint16_t glass = test::add_glass(block, 1.5f, 0.5f);
    test::add_box(block, {2, 3, 0}, {7, 7, 4}, glass);
    Scene with_ball = block, with_other = block;
    with_ball.spheres.push_back({glm::dvec3(4.5, 5.0, 2.0), 1.5, glass});
    test::expect_equal_light(render(with_ball, 64), render(block, 64), "same glass");
    with_other.spheres.push_back({glm::dvec3(4.5, 5.0, 2.0), 1.5, test::add_glass(with_other, 1.5f, 0.5f)});
    EXPECT_GT(test::light_z(render(with_other, 64), render(block, 64)).rms,
              1.5 * test::kMaxRms);  // negative control
}

TEST(Row28Nightly, camera_inside_glass_agrees_with_paths) {
    Scene scene = voxel_room(32);
    test::add_box(scene, {3, 0, 2}, {7, 3, 6}, test::add_glass(scene, 1.4f));
    scene.camera = test::camera_towards({5.0, 1.0, 4.0}, {5.0, 10.0, 3.0}, 40.0);
    test::expect_equal_light(render(scene, 64), truth_of(scene, 512), "camera in voxels");
    Scene ball = voxel_room(32);
    ball.spheres.push_back({glm::dvec3(5.0, 2.0, 4.0), 1.5, test::add_glass(ball, 1.4f)});
    ball.camera = test::camera_towards({5.1, 1.6, 4.2}, {5.0, 10.0, 3.0}, 40.0);
    test::expect_equal_light(render(ball, 64), truth_of(ball, 512), "camera in a ball");
}

TEST(Row30, black_walls_send_nothing_on) {
    Scene scene = voxel_room(16);
    for (Material& material : scene.materials)
        material.albedo = glm::vec3(0.0f);
    const LightPicture picture = render(scene, 4, 1);
    for (const test::TruthPixel& pixel : picture.pixels)
        EXPECT_TRUE(pixel.mean == glm::dvec3(0.0) || pixel.mean == glm::dvec3(12.0));
    test::FrameFixture fixture(scene, PlanRequest{});
    EXPECT_EQ(fixture.render(0).counters[gpu::kWorkPhotonsStored], 0u);  // nobody gathers them
    EXPECT_GT(test::FrameFixture(voxel_room(16), PlanRequest{}).render(0).counters[gpu::kWorkPhotonsStored],
              0u);
}

TEST(Row30Nightly, walls_of_albedo_0_and_1_agree_with_paths) {
    Scene scene = voxel_room(32);
    scene.materials[0].albedo = {1.0f, 0.0f, 0.5f};
    scene.materials[2].albedo = {0.0f, 1.0f, 1.0f};
    test::expect_equal_light(render(scene, 64), truth_of(scene, 512), "0 and 1");
}

// Row 31. Light is linear in the emitters, from the faintest that a sum of 64 bits can hold to the brightest.
TEST(Row31, emitters_of_any_power_give_the_same_picture_in_their_units) {
    const auto first_sample = [](float radiance) {
        Scene scene = voxel_room(16);
        scene.materials[1].emission = glm::vec3(radiance);
        return test::FrameFixture(scene, PlanRequest{}).render(0);
    };
    const auto one = first_sample(1.0f);
    for (const float radiance : {1e-20f, 1e-6f, 1e6f, 1e30f}) {
        const auto scaled = first_sample(radiance);
        for (std::size_t i = 0; i < one.color.size(); ++i)
            ASSERT_NEAR(scaled.color[i].x / radiance, one.color[i].x, 1e-4 * one.color[i].x + 1e-6)
                << radiance;
        EXPECT_EQ(scaled.counters[gpu::kFaultPhotonPower], 0u) << radiance;
        EXPECT_EQ(scaled.counters[gpu::kFaultFilmNonFinite], 0u) << radiance;
    }
}

TEST(Row31, emitter_too_faint_for_photons_is_no_fault) {
    for (const float radiance : {0.0f, 1e-30f, 1e-38f}) {
        Scene scene = voxel_room(16);
        scene.materials[1].emission = glm::vec3(radiance, 0.0f, 0.0f);
        const test::FramePlanes planes = test::FrameFixture(scene, PlanRequest{}).render(0);
        for (std::size_t f = 0; f < gpu::kFaultCount; ++f)
            EXPECT_EQ(planes.counters[f], 0u) << gpu::kCounterNames[f] << ' ' << radiance;
        for (const glm::vec3& colour : planes.color)
            ASSERT_TRUE(colour.x >= 0.0f && colour.x < 1e-20f && colour.y == 0.0f) << radiance;
    }
}

TEST(Row31, faint_emitter_beside_a_bright_one_and_many_emitters_agree_with_paths) {
    Scene scene = voxel_room(32);
    test::add_box(scene, {1, 9, 1}, {2, 10, 2}, test::add_emitter(scene, 1e-30f));
    test::add_box(scene, {0, 3, 5}, {1, 4, 6}, test::add_emitter(scene, 300.0f));
    for (int i = 0; i < 9; ++i)
        test::add_box(scene, {i, 9, 7}, {i + 1, 10, 8},
                      test::add_emitter(scene, 0.2f * static_cast<float>(i)));
    test::expect_equal_light(render(scene, 64), truth_of(scene, 2048), "many lamps");
}

// Row 32 and 33. Light of the sun through an opening, which only photons carry on.
Scene sunny_room() {
    Scene scene = test::dark_scene(32, 32768, 0.1);
    test::add_room(scene, {8, 8, 6}, test::add_diffuse(scene, 0.7f));
    scene.sun = {.azimuth_deg = 250.0f,
                 .elevation_deg = 55.0f,
                 .angular_diameter_deg = 8.0f,
                 .irradiance = {10.0f, 9.0f, 7.0f}};
    scene.camera = test::camera_towards({4.0, 0.4, 3.0}, {4.2, 8.0, 2.6}, 75.0);
    // The ceiling's cells over the opening are taken out of its box, the second of the room.
    std::erase_if(scene.models[1].voxels,
                  [](const Voxel& v) { return v.x >= 4 && v.x < 6 && v.y >= 3 && v.y < 5; });
    return scene;
}

const EffectRequest kForcedIndirect{.switches = {{Effect::indirect, Switch::on}}};

TEST(Row33, sunlight_through_an_opening_agrees_with_paths) {
    const Scene scene = sunny_room();
    test::expect_equal_light(render(scene, 64, kBlock, kForcedIndirect), truth_of(scene, 2048), "opening");
}

TEST(Row33, sunlight_through_a_pane_of_glass_agrees_with_paths) {
    Scene scene = sunny_room();
    scene.sun.angular_diameter_deg = 25.0f;  // wide, because the path tracer finds it by chance
    test::add_box(scene, {3, 2, 6}, {5, 4, 7}, test::add_glass(scene, 1.5f));
    test::expect_equal_light(render(scene, 64, kBlock, kForcedIndirect), truth_of(scene, 4096), "pane");
}

// Row 34. A lit and a dark room with a wall of one voxel between them, on one floor.
Scene two_rooms(double radius) {
    Scene scene = test::dark_scene(64, 65536, radius);
    test::add_room(scene, {9, 6, 5}, test::add_diffuse(scene, 0.8f));
    test::add_box(scene, {4, 0, 0}, {5, 6, 5}, 0);
    test::add_box(scene, {1, 2, 5}, {3, 4, 6}, test::add_emitter(scene, 50.0f));
    scene.camera = test::camera_towards({8.8, 3.0, 4.8}, {5.0, 3.0, 1.0}, 80.0);  // in the dark room
    return scene;
}

TEST(Row34, dark_room_behind_a_wall_of_one_voxel_stays_exactly_black) {
    const Scene scene = two_rooms(0.99);  // the floor goes on under the wall; the disc ends within it
    for (const test::TruthPixel& pixel : render(scene, 4, 1).pixels)
        ASSERT_EQ(pixel.mean, glm::dvec3(0.0));
}

// A disc that is wider than the wall reaches under it, but no farther than its radius.
TEST(Row34, wide_disc_leaks_along_a_shared_floor_by_its_radius_alone) {
    constexpr double kRadius = 1.75;
    Scene scene = two_rooms(kRadius);
    scene.camera = test::camera_down({7.0, 3.0, 4.9}, 44.0);
    const LightPicture picture = render(scene, 4, 1);
    const double half = std::tan(22.0 * kPi / 180.0) * 4.9;
    int leaking = 0;
    for (int x = 0; x < 64; ++x) {
        const double left = 7.0 + half * (2.0 * x - 64.0) / 64.0;  // of the pixel, on the floor
        for (int y = 0; y < 64; ++y) {
            const bool is_dark = picture.at({x, y}).mean == glm::dvec3(0.0);
            ASSERT_TRUE(is_dark || left <= 4.0 + kRadius) << x << ' ' << y;
            leaking += is_dark ? 0 : 1;
        }
    }
    EXPECT_GT(leaking, 100) << "negative control: light does get under the wall";
}

// Rooms that touch only along an edge. The camera sees walls, but neither floor nor ceiling: their planes are
// shared by both rooms, so discs reach past the edge there, as in the case above.
TEST(Row34, dark_room_behind_an_edge_stays_exactly_black) {
    Scene scene = test::dark_scene(32, 65536, 0.4);
    const std::uint16_t wall = test::add_diffuse(scene, 0.8f);
    test::add_room(scene, {8, 8, 5}, wall);
    test::add_box(scene, {4, 0, 0}, {8, 4, 5}, wall);
    test::add_box(scene, {0, 4, 0}, {4, 8, 5}, wall);  // left: (0..4, 0..4) and (4..8, 4..8)
    test::add_box(scene, {1, 1, 5}, {3, 3, 6}, test::add_emitter(scene, 50.0f));
    scene.camera = test::camera_towards({7.8, 7.8, 2.5}, {4.0, 4.0, 2.5}, 30.0);
    for (const test::TruthPixel& pixel : render(scene, 4, 1).pixels)
        ASSERT_EQ(pixel.mean, glm::dvec3(0.0));
}

TEST(Row36Nightly, roulette_changes_no_mean) {
    Scene scene = voxel_room(32);
    scene.settings.photons.roulette = false;
    scene.settings.photons.depth = 40;  // 0.7^40 is less than 1e-6
    const LightPicture all = render(scene, 48);
    scene.settings.photons.roulette = true;
    scene.settings.seed = 99;
    test::expect_equal_light(render(scene, 48), all, "roulette");
    scene.settings.photons.roulette = false;
    scene.settings.photons.depth = 2;
    EXPECT_GT(test::light_z(render(scene, 48), all).rms, test::kMaxRms) << "negative control: paths cut off";
}

// Between perfect mirrors a path never ends. Between good mirrors roulette ends it.
TEST(Row36, endless_paths_between_mirrors_end_and_are_counted) {
    for (const float albedo : {1.0f, 0.99f}) {
        Scene scene = test::dark_scene(8, 1024, 0.1);
        test::add_room(scene, {4, 4, 4}, test::add_mirror(scene, albedo));
        scene.camera = test::camera_towards({2.0, 1.0, 2.0}, {2.3, 4.0, 2.1}, 40.0);
        const test::FramePlanes planes = test::FrameFixture(scene, PlanRequest{}).render(0);
        EXPECT_EQ(planes.counters[gpu::kFaultPathTooLong], albedo == 1.0f ? 64u : 0u);
        for (const glm::vec3& colour : planes.color)
            EXPECT_EQ(colour, glm::vec3(0.0f));
    }
}

// Seen in a mirror, and through the ball that makes it, a caustic is light that shadow rays find at neither
// end. The tracer that waits for paths to hit the emitter finds it from the camera's end alone.
TEST(Row36, caustic_seen_in_a_mirror_and_through_its_ball_is_reciprocal) {
    Scene scene = test::dark_scene(32, 16384, 0.1);
    test::add_room(scene, {10, 10, 8}, test::add_diffuse(scene, 0.6f));
    test::add_box(scene, {2, 10, 0}, {8, 11, 6}, test::add_mirror(scene, 0.9f));
    test::add_box(scene, {3, 3, 8}, {7, 7, 9}, test::add_emitter(scene, 4.0f));
    scene.spheres.push_back({glm::dvec3(5.0, 6.0, 2.2), 2.0, test::add_glass(scene, 1.5f)});
    scene.camera = test::camera_towards({5.0, 0.4, 4.0}, {5.0, 6.0, 2.0}, 60.0);
    const LightPicture by_chance =
        test::truth_picture(test::truth_world(scene),
                            {.size = scene.settings.size / kBlock, .spp = 4096, .samples_emitters = false});
    test::expect_equal_light(render(scene, 64), by_chance, "reciprocity");
}

}  // namespace
}  // namespace voxilux
