// The passes shade.resolve, aov.* and film.add: radiance in closed form, and sums that lose nothing.

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>

#include "film/film.h"
#include "plan/film_planes.h"
#include "shared/film_sum.h"
#include "shared/sampling.h"
#include "support/frame_fixture.h"
#include "support/test_scenes.h"

namespace voxilux {
namespace {

// Three roundings of a float: the products of albedo, irradiance, cosine and 1 / pi may be taken in any
// order.
constexpr float kProductError = 4.0f * 0x1p-24f;

Scene plane_scene() {
    Scene scene = test::white_scene();
    test::add_box(scene, {-40, -40, -1}, {40, 40, 0});
    scene.camera = test::camera_towards({0, -20, 15}, {0, 0, 0}, 60.0);
    scene.settings.size = {24, 20};
    return scene;
}

std::int64_t fixed(float value) {
    const gpu::FilmFixed converted = gpu::film_fixed(value);
    EXPECT_EQ(converted.flags, 0u);
    return static_cast<std::int64_t>(std::uint64_t{converted.sum.y} << 32 | converted.sum.x);
}

// The square as the film sums it: a product of floats, rounded to 2^-24 once more.
std::int64_t square(float value) {
    const float product = value * value;
    return std::llrint(std::ldexp(static_cast<double>(product), gpu::kFilmFractionBits));
}

TEST(ShadeResolve, plane_under_a_constant_sky_is_albedo_times_radiance_exactly) {
    Scene scene = plane_scene();
    const glm::vec3 albedo(0.1f, 0.37f, 0.83f);
    scene.sky.radiance = glm::vec3(0.9f, 1.1f, 2.3f);
    scene.materials[0].albedo = albedo;
    const test::FramePlanes planes = test::render_first_sample(scene);
    int on_plane = 0;
    for (std::size_t i = 0; i < planes.hits.size(); ++i) {
        const bool is_hit = planes.hits[i].face == 5u;
        on_plane += is_hit ? 1 : 0;
        ASSERT_EQ(planes.color[i], is_hit ? albedo * scene.sky.radiance : scene.sky.radiance);
    }
    EXPECT_GT(on_plane, 200);
    EXPECT_EQ(planes.counters[gpu::kWorkHits], static_cast<gpu::uint>(on_plane));
}

TEST(ShadeResolve, plane_under_sky_and_hard_sun_is_the_closed_form) {
    Scene scene = plane_scene();
    scene.sun = {.azimuth_deg = 70.0f, .elevation_deg = 35.0f, .angular_diameter_deg = 0.0f};
    scene.materials[0].albedo = glm::vec3(0.1f, 0.37f, 0.83f);
    const test::FramePlanes planes = test::render_first_sample(scene);
    const glm::vec3 direct = scene.sun.irradiance * (scene.sun.direction().z / std::numbers::pi_v<float>);
    const glm::vec3 want = scene.materials[0].albedo * (scene.sky.radiance + direct);
    for (std::size_t i = 0; i < planes.hits.size(); ++i) {
        if (planes.hits[i].face != 5u) continue;
        for (int c = 0; c < 3; ++c)
            ASSERT_NEAR(planes.color[i][c], want[c], kProductError * want[c]);
    }
}

// Convex things in a white furnace: albedo 1, sky 1, nothing occluded, so they vanish, exactly.
TEST(ShadeResolve, convex_things_vanish_in_a_white_furnace) {
    std::vector<Scene> scenes(4, test::white_scene());
    test::add_box(scenes[0], {0, 0, 0}, {1, 1, 1});
    test::add_box(scenes[1], {-5, -3, 0}, {4, 6, 9});
    scenes[2].spheres.push_back({glm::dvec3(0.5, 0.25, 0.125), 3.0, 0});
    scenes[3] = plane_scene();
    for (Scene& scene : scenes) {
        scene.settings.size = {32, 24};
        scene.settings.ao_rays = 8;
        test::FrameFixture rig(scene);
        for (std::uint32_t sample = 0; sample < 3; ++sample) {
            const test::FramePlanes planes = rig.render(sample);
            EXPECT_GT(planes.counters[gpu::kWorkHits], 100u);
            for (const glm::vec3& color : planes.color)
                ASSERT_EQ(color, glm::vec3(1.0f));
        }
        for (const std::int64_t sum : rig.film_sums("beauty_a"))
            ASSERT_EQ(sum, std::int64_t{2} << gpu::kFilmFractionBits);
    }
}

TEST(ShadeResolve, emission_is_added_to_what_is_reflected) {
    Scene scene = plane_scene();
    scene.materials[0].albedo = glm::vec3(0.5f);
    scene.materials[0].emission = glm::vec3(3.0f, 0.25f, 17.0f);
    const test::FramePlanes planes = test::render_first_sample(scene);
    for (std::size_t i = 0; i < planes.hits.size(); ++i) {
        if (planes.hits[i].face != 5u) continue;
        ASSERT_EQ(planes.color[i], glm::vec3(3.5f, 0.75f, 17.5f));
    }
}

TEST(ShadeResolve, inside_of_a_solid_shows_its_emission_only) {
    Scene scene = plane_scene();
    scene.sun.on = true;
    scene.materials[0].emission = glm::vec3(0.0f, 0.5f, 0.0f);
    scene.camera = Camera{.position = glm::dvec3(0.5, 0.5, -0.5)};
    for (const glm::vec3& color : test::render_first_sample(scene).color)
        ASSERT_EQ(color, glm::vec3(0.0f, 0.5f, 0.0f));
}

// Every plane of the film is the exact sum of what the passes wrote, each value rounded once to 2^-24.
TEST(FilmAdd, sums_of_every_plane_are_exact) {
    Scene scene = plane_scene();
    scene.sun.on = true;
    test::add_box(scene, {-3, -3, 0}, {3, 3, 6});
    scene.materials[0].albedo = glm::vec3(0.3f, 0.6f, 0.9f);
    scene.settings.ao_rays = 3;
    test::FrameFixture rig(scene);
    std::vector<std::int64_t> ao(480), sun(480), a(480 * 3), b(480 * 3), squares(480 * 3);
    for (std::uint32_t sample = 0; sample < 5; ++sample) {
        const test::FramePlanes planes = rig.render(sample);
        for (std::size_t i = 0; i < 480; ++i) {
            ao[i] += fixed(planes.ao[i]);
            sun[i] += fixed(planes.sun[i]);
            for (std::size_t c = 0; c < 3; ++c)
                (sample % 2 == 0 ? a : b)[3 * i + c] += fixed(planes.color[i][static_cast<int>(c)]);
            for (std::size_t c = 0; c < 3; ++c)
                squares[3 * i + c] += square(planes.color[i][static_cast<int>(c)]);
        }
    }
    EXPECT_EQ(rig.film_sums("ao"), ao);
    EXPECT_EQ(rig.film_sums("sun"), sun);
    EXPECT_EQ(rig.film_sums("beauty_a"), a);
    EXPECT_EQ(rig.film_sums("beauty_b"), b);
    EXPECT_EQ(rig.film_sums("squares"), squares);
    squares[77] += 1;
    EXPECT_NE(rig.film_sums("squares"), squares);
    a[77] += 1;
    EXPECT_NE(rig.film_sums("beauty_a"), a);
}

TEST(FilmAdd, bad_values_are_counted_and_kept_out_of_the_sums) {
    const std::vector<float> values = {1.5f, std::nanf(""), INFINITY, -INFINITY, 1e9f, -1e9f, 0.0f, -2.0f};
    const std::vector<std::int64_t> want = {
        fixed(1.5f), 0, 0, 0, fixed(gpu::kFilmMaxValue), -fixed(gpu::kFilmMaxValue), 0, -fixed(2.0f)};
    Recording recording;
    recording.declare({.name = "t.values", .size_bytes = values.size() * sizeof(float)});
    recording.declare({.name = "t.sums", .size_bytes = values.size() * sizeof(std::int64_t)});
    recording.declare({.name = "t.tally", .size_bytes = gpu::kCounterCount * sizeof(gpu::uint)});
    recording.upload("t.values", std::as_bytes(std::span(values)));
    recording.clear("t.sums");
    recording.clear("t.tally");
    const gpu::FilmAddPush push{static_cast<gpu::uint>(values.size()), 1, 0};
    recording.dispatch({.label = "film.add",
                        .shader = "film_add",
                        .extent = {push.count, 1, 1},
                        .bindings = {{"Counters", "t.tally"}, {"Values", "t.values"}, {"Sums", "t.sums"}},
                        .push = to_bytes(push)});
    recording.readback("t.sums");
    recording.readback("t.tally");
    const RunResult result = test_executor().run(recording);
    std::vector<std::int64_t> sums(values.size());
    std::memcpy(sums.data(), result.readbacks.at("t.sums").data(), sums.size() * sizeof(std::int64_t));
    std::array<gpu::uint, gpu::kCounterCount> counters{};
    std::memcpy(counters.data(), result.readbacks.at("t.tally").data(), sizeof(counters));
    EXPECT_EQ(sums, want);
    EXPECT_EQ(counters[gpu::kFaultFilmNonFinite], 3u);
    EXPECT_EQ(counters[gpu::kFaultFilmClamped], 2u);
}

// Surface AOVs are means over samples; position and depth are those of the first.
TEST(Aov, albedo_and_normal_follow_the_hits) {
    Scene scene = plane_scene();
    scene.materials.push_back({.name = "red", .albedo = glm::vec3(0.75f, 0.5f, 0.25f)});
    test::add_box(scene, {-4, -4, 0}, {4, 4, 5}, 1);
    test::FrameFixture rig(scene);
    const test::FramePlanes planes = rig.render(0);
    const std::vector<std::int64_t> albedo = rig.film_sums("albedo");
    const std::vector<std::int64_t> normal = rig.film_sums("normal");
    for (std::size_t i = 0; i < planes.hits.size(); ++i) {
        const gpu::Hit& hit = planes.hits[i];
        const bool is_hit = hit.face != gpu::kFaceMiss;
        const glm::vec3 want_albedo = is_hit ? scene.materials[hit.material].albedo : glm::vec3(0.0f);
        const glm::vec3 want_normal = is_hit ? gpu::face_normal(hit.face) : glm::vec3(0.0f);
        for (std::size_t c = 0; c < 3; ++c) {
            ASSERT_EQ(albedo[3 * i + c], fixed(want_albedo[static_cast<int>(c)]));
            ASSERT_EQ(normal[3 * i + c], fixed(want_normal[static_cast<int>(c)]));
        }
    }
}

}  // namespace
}  // namespace voxilux
