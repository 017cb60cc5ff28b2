// Paths against closed forms, and against the tests' own path tracer where there are mirrors and glass.

#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include "formats/scene_toml.h"
#include "scene/scene_camera.h"
#include "scene/technique_choice.h"
#include "shared/counters.h"
#include "support/frame_fixture.h"
#include "support/light_pictures.h"
#include "support/light_scenes.h"

namespace voxilux {
namespace {

using test::LightPicture;
using test::PictureZ;
using test::TruthPixel;

constexpr double kPi = std::numbers::pi;
constexpr double kFarOff = 4.0;     // standard deviations; normal noise passes them once in 16000 times
constexpr double kRounding = 2e-5;  // relative, of chains of floats

Scene traced(Scene scene) {
    choose_technique("indirect", "paths", scene.settings);
    choose_technique("caustics", "paths", scene.settings);
    return scene;
}

LightPicture render(const Scene& scene, std::uint32_t samples, int block = 1) {
    const std::array blocks{block};
    return test::render_light(traced(scene), {samples, blocks, {}}).front();
}

double farthest(const PictureZ& z) {
    return std::max({std::abs(z.of_mean.x), std::abs(z.of_mean.y), std::abs(z.of_mean.z)});
}

// The picture's distance from one radiance everywhere, in standard deviations.
PictureZ z_of(const LightPicture& picture, const glm::dvec3& radiance) {
    const TruthPixel pixel{radiance, glm::pow(kRounding * radiance, glm::dvec3(2.0))};
    return test::light_z(picture, {picture.size, std::vector<TruthPixel>(picture.pixels.size(), pixel)});
}

double relative_noise(const TruthPixel& pixel, const glm::dvec3& radiance) {
    const glm::dvec3 noise = glm::sqrt(pixel.variance_of_mean) / radiance;
    return std::max({noise.x, noise.y, noise.z});
}

// A closed room with blocks inside, where everything emits E and reflects the fraction a: radiance E / (1 -
// a).
Scene furnace(const glm::vec3& albedo, const glm::vec3& emission) {
    Scene scene = test::dark_scene(16, 1024, 1.0);
    const std::uint16_t wall = test::add_material(
        scene, {.name = "wall", .albedo = albedo, .emission = emission, .surface = Surface::emit});
    test::add_room(scene, {8, 7, 6}, wall);
    test::add_box(scene, {5, 3, 0}, {7, 5, 4}, wall);
    test::add_box(scene, {1, 5, 2}, {2, 6, 3}, wall);
    scene.camera = test::camera_towards({1.2, 0.8, 3.0}, {6.0, 5.0, 1.0}, 70.0);
    return scene;
}

TEST(PathForms, p1_furnace_of_any_geometry_is_evenly_bright) {
    const LightPicture picture = render(furnace({0.2f, 0.5f, 0.8f}, {0.8f, 0.5f, 0.3f}), 128);
    const PictureZ z = z_of(picture, {1.0, 1.0, 1.5});
    EXPECT_LT(z.rms, 1.15);
    EXPECT_LT(farthest(z), kFarOff);
}

TEST(PathForms, p1_furnace_that_emits_a_hundredth_more_is_caught) {
    const LightPicture picture = render(furnace({0.2f, 0.5f, 0.8f}, {0.808f, 0.505f, 0.303f}), 128);
    EXPECT_GT(farthest(z_of(picture, {1.0, 1.0, 1.5})), kFarOff);
}

// A path meets 1000 walls on average, so it goes on through several rounds of dispatches.
TEST(PathForms, p2_furnace_of_albedo_0_999_loses_nothing) {
    const Scene scene = furnace({0.9f, 0.99f, 0.999f}, {0.1f, 0.01f, 0.001f});
    EXPECT_GT(test::FrameFixture(traced(scene), PlanRequest{}).plan().paths.rounds, 1u);
    const LightPicture whole = render(scene, 16, 16);
    EXPECT_LT(farthest(z_of(whole, glm::dvec3(1.0))), kFarOff);
    EXPECT_LT(relative_noise(whole.pixels.front(), glm::dvec3(1.0)), 0.04);
}

// Every path ends in the sky, and no reflection loses light.
TEST(PathForms, p3_white_niches_under_a_white_sky_are_exactly_white_in_every_sample) {
    Scene scene = test::dark_scene(32, 1024, 1.0);
    scene.sky.radiance = glm::vec3(1.0f);
    const std::uint16_t chalk = test::add_diffuse(scene, 1.0f);
    test::add_box(scene, {-7, -7, -1}, {7, 7, 0}, chalk);
    for (const glm::ivec2 corner : {glm::ivec2(-5, -5), glm::ivec2(-2, -2), glm::ivec2(2, -4)})
        for (int side = 0; side < 2; ++side)
            test::add_box(scene, {corner.x + 2 * side, corner.y, 0},
                          {corner.x + 2 * side + 1, corner.y + 3, 6}, chalk);
    scene.camera = test::camera_towards({-12, -15, 14}, {0, 0, 1}, 45.0);
    test::FrameFixture fixture(traced(scene), PlanRequest{});
    for (std::uint32_t sample = 0; sample < 8; ++sample)
        for (const glm::vec3& colour : fixture.render(sample).color)
            ASSERT_EQ(colour, glm::vec3(1.0f)) << sample;
}

// An emitter of radius r in a hollow ball of radius R and albedo a: all reflections in a geometric series.
TEST(PathForms, p16_emitter_in_a_hollow_ball_gives_the_series_of_reflections) {
    Scene scene = test::dark_scene(16, 1024, 1.0);
    scene.spheres.push_back(
        {glm::dvec3(0.0), 4.0, test::add_material(scene, {.albedo = {0.25f, 0.5f, 0.75f}})});
    scene.spheres.push_back({glm::dvec3(0.0), 1.0, test::add_emitter(scene, 8.0f)});
    scene.camera = test::camera_towards({0.0, -2.0, 0.0}, {0.0, -4.0, 0.0}, 40.0);
    glm::dvec3 expected;
    for (int c = 0; c < 3; ++c) {
        const double a = 0.25 * (c + 1), part = 1.0 / 16.0;
        expected[c] = a * 8.0 * part / (1.0 - a * (1.0 - part));
    }
    const LightPicture picture = render(scene, 256, 16);
    EXPECT_LT(farthest(z_of(picture, expected)), kFarOff);
    EXPECT_LT(relative_noise(picture.pixels.front(), expected), 0.005);
}

// Share of the cosine-weighted hemisphere about a horizontal normal (0, -1, 0) at `eye` that a rectangle of
// the plane z = 0 fills. Source: Lambert 1760, the sum over the edges of a polygon.
double form_factor(const glm::dvec3& eye, const glm::dvec2& low, const glm::dvec2& high) {
    const std::array<glm::dvec3, 4> corners = {glm::dvec3(low, 0.0), glm::dvec3(high.x, low.y, 0.0),
                                               glm::dvec3(high, 0.0), glm::dvec3(low.x, high.y, 0.0)};
    double sum = 0.0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec3 a = glm::normalize(corners[i] - eye), b = glm::normalize(corners[(i + 1) % 4] - eye);
        sum += std::acos(glm::dot(a, b)) * glm::normalize(glm::cross(a, b)).y;
    }
    return std::abs(sum) / (2.0 * kPi);
}

// One white square of a black floor under the sun, and a white voxel of a wall that faces it: exactly one
// bounce, except for what the square gets back from the voxel, at most a thousandth.
TEST(PathForms, one_bounce_of_the_sun_is_the_form_factor) {
    Scene scene = test::dark_scene(16, 1024, 1.0);
    const std::uint16_t black = test::add_diffuse(scene, 0.0f), white = test::add_diffuse(scene, 1.0f);
    test::add_box(scene, {-10, -10, -1}, {10, 0, 0}, black);
    test::add_box(scene, {-3, -9, -1}, {3, -4, 0}, white);
    test::add_box(scene, {0, 0, 3}, {1, 1, 4}, white);
    scene.sun = {.elevation_deg = 90.0f, .angular_diameter_deg = 0.0f, .irradiance = glm::vec3(2.0f)};
    // A square of a tenth of a voxel in the middle of the voxel's face.
    scene.camera =
        test::camera_towards({0.5, -2.0, 3.5}, {0.5, 0.0, 3.5}, 2.0 * 180.0 / kPi * std::atan(0.025));
    const double expected = 2.0 / kPi * form_factor({0.5, 0.0, 3.5}, {-3.0, -9.0}, {3.0, -4.0});
    const LightPicture picture = render(scene, 512, 16);
    EXPECT_LT(farthest(z_of(picture, glm::dvec3(expected))), kFarOff);
    EXPECT_LT(relative_noise(picture.pixels.front(), glm::dvec3(expected)), 0.011);
}

// The picture of the tests' own path tracer, in blocks.
struct Traced {
    std::string scene;
    glm::ivec2 size{24, 24};  // blocks
    std::uint32_t samples = 64;
    int truth_spp = 256;
};

void PrintTo(const Traced& one, std::ostream* out) {
    *out << one.scene;
}

constexpr int kBlock = 2;

Scene scene_of(const Traced& one) {
    const glm::ivec2 size = one.size * kBlock;
    Scene scene = load_scene(std::filesystem::path(VX_SOURCE_DIR) / "scenes" / (one.scene + ".toml"),
                             {.overrides = {fmt::format("render.size=[{}, {}]", size.x, size.y)}});
    scene.camera = camera_of(scene);
    return scene;
}

void expect_truth(const Scene& scene, const Traced& one) {
    const LightPicture truth =
        test::truth_picture(test::truth_world(scene), {.size = one.size, .spp = one.truth_spp, .seed = 11});
    test::expect_equal_light(render(scene, one.samples, kBlock), truth, "picture");
}

class PathTruth : public testing::TestWithParam<Traced> {};

TEST_P(PathTruth, picture_agrees_with_an_independent_tracer) {
    expect_truth(scene_of(GetParam()), GetParam());
}

INSTANTIATE_TEST_SUITE_P(Scenes, PathTruth,
                         testing::Values(Traced{"cornell"}, Traced{"glass_block"}, Traced{"glass_in_glass"},
                                         Traced{"mixed"}, Traced{"emitters"}),
                         [](const auto& tested) { return tested.param.scene; });

// Voxels of mirror and glass in a court under a wide sun and a sky. A block of glass stands on the floor.
Scene glints() {
    Scene scene = test::dark_scene(48, 1024, 1.0);
    scene.sky.radiance = {0.2f, 0.25f, 0.3f};
    scene.sun = {.azimuth_deg = 215.0f, .elevation_deg = 40.0f, .angular_diameter_deg = 10.0f};
    const std::uint16_t stone = test::add_diffuse(scene, 0.6f);
    test::add_box(scene, {-10, -10, -1}, {10, 10, 0}, stone);
    test::add_box(scene, {3, -10, 0}, {4, 10, 7}, test::add_mirror(scene, 0.9f));
    test::add_box(scene, {-6, 4, 0}, {-1, 5, 5}, test::add_glass(scene, 1.5f, 0.8f));
    test::add_box(scene, {-5, -4, 0}, {-2, -1, 2}, test::add_glass(scene, 1.5f));
    test::add_box(scene, {-8, 6, 0}, {2, 7, 6}, test::add_diffuse(scene, 0.8f));
    scene.camera = test::camera_towards({-9, -14, 14}, {-1, 0, 1}, 45.0);
    return scene;
}

TEST(PathTruth, p15_sun_by_way_of_mirrors_and_glass_agrees_with_an_independent_tracer) {
    expect_truth(glints(), {.scene = "glints", .samples = 96, .truth_spp = 2048});
}

TEST(PathTruth, p15_glass_that_takes_a_fifth_more_is_caught) {
    Scene scene = glints();
    const LightPicture truth =
        test::truth_picture(test::truth_world(scene), {.size = {24, 24}, .spp = 1024, .seed = 11});
    for (Material& material : scene.materials)
        if (material.surface == Surface::glass) material.albedo *= 0.8f;
    EXPECT_FALSE(test::is_equal_light(render(scene, 96, kBlock), truth));
}

// A sun a tenth as wide as the real one: light that chance hardly ever finds has little noise, and is as much
// as that of a wide sun.
TEST(PathTruth, p15_small_sun_gives_as_much_light_as_a_wide_one) {
    Scene wide = glints();
    Scene small = wide;
    small.sun.angular_diameter_deg = 0.05f;
    const LightPicture a = render(small, 64, 16), b = render(wide, 64, 16);
    glm::dvec3 light_a(0.0), light_b(0.0);
    double noise_a = 0.0, noise_b = 0.0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        light_a += a.pixels[i].mean;
        light_b += b.pixels[i].mean;
        noise_a += a.pixels[i].variance_of_mean.y;
        noise_b += b.pixels[i].variance_of_mean.y;
    }
    // The edges of shadows differ, but far less than the light of mirrors and glass.
    EXPECT_NEAR(light_a.y / light_b.y, 1.0, 0.02);
    EXPECT_LT(noise_a, 2.0 * noise_b);
}

}  // namespace
}  // namespace voxilux
