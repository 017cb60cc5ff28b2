// The tests' own path tracer against closed forms.

#include "support/path_truth.h"

#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "formats/scene_toml.h"
#include "support/statistics.h"

namespace voxilux {
namespace {

using test::TruthPixel;
using test::TruthRequest;

// Standard deviations; normal noise passes them once in 16000 times, and seeds are fixed.
constexpr double kFarOff = 4.0;
constexpr double kRounding = 1e-6;  // relative, of the floats in a scene

Scene dark_scene(const std::string& rest) {
    return parse_scene("[sun]\non = false\n[sky]\nradiance = [0, 0, 0]\n" + rest, "s.toml");
}

Scene scene_in_white_sky(const std::string& rest) {
    return parse_scene("[sun]\non = false\n[sky]\nradiance = [1, 1, 1]\n" + rest, "s.toml");
}

TruthPixel one_pixel(const Scene& scene, int spp) {
    return trace_truth_pixel(test::truth_world(scene), {.size = {1, 1}, .spp = spp, .seed = 3}, {0, 0});
}

double z_of(const TruthPixel& pixel, double expected) {
    const double variance = pixel.variance_of_mean.x + std::pow(kRounding * expected, 2.0);
    return (pixel.mean.x - expected) / std::sqrt(variance);
}

// An emitter of radius r and radiance L in the middle of a hollow ball of radius R and albedo a. The wall
// gets pi L F straight from it, with F = (r / R)^2, and from itself all that it sends but the part F that
// ends in the emitter: its radiance is a L F / (1 - a (1 - F)).
constexpr double kEmitterRadiance = 8.0;
constexpr double kEmitterPart = 0.25 * 0.25;
double wall_radiance(double albedo) {
    return albedo * kEmitterRadiance * kEmitterPart / (1.0 - albedo * (1.0 - kEmitterPart));
}

Scene hollow_ball(const std::string& wall) {
    return dark_scene(
        "[camera]\nposition = [0, -2, 0]\nyaw = -90\npitch = 0\nfov = 20\n"
        "[material.wall]\n" +
        wall +
        "[material.lamp]\nalbedo = [0, 0, 0]\nemission = [8, 8, 8]\n"
        "[[sphere]]\ncenter = [0, 0, 0]\nradius = 4\nmaterial = \"wall\"\n"
        "[[sphere]]\ncenter = [0, 0, 0]\nradius = 1\nmaterial = \"lamp\"\n");
}

TEST(PathTruth, emitter_in_a_hollow_ball_gives_the_series_of_reflections) {
    const Scene scene = hollow_ball("albedo = [0.25, 0.5, 0.75]\n");
    const TruthPixel pixel = one_pixel(scene, 40000);
    for (int c = 0; c < 3; ++c) {
        const double want = wall_radiance(0.25 * (c + 1));
        EXPECT_LT(std::abs(pixel.mean[c] - want), kFarOff * std::sqrt(pixel.variance_of_mean[c])) << want;
        EXPECT_LT(std::sqrt(pixel.variance_of_mean[c]), 0.01 * want);
    }
}

TEST(PathTruth, albedo_off_by_a_fiftieth_is_caught) {
    const TruthPixel pixel = one_pixel(hollow_ball("albedo = [0.735, 0.735, 0.735]\n"), 40000);
    EXPECT_GT(std::abs(z_of(pixel, wall_radiance(0.75))), kFarOff);
}

TEST(PathTruth, mirror_shows_the_sky_in_its_colour) {
    const Scene scene = scene_in_white_sky(
        "[camera]\nposition = [0, -10, 0]\nlook_at = [0, 0, 0]\nfov = 5\n"
        "[material.m]\nalbedo = [0.5, 0.5, 0.5]\nsurface = \"metal\"\n"
        "[[sphere]]\ncenter = [0, 0, 0]\nradius = 4\nmaterial = \"m\"\n");
    EXPECT_EQ(one_pixel(scene, 16).mean, glm::dvec3(0.5));
}

// What loses no light is invisible in a uniform sky.
TEST(PathTruth, white_furnace_of_glass_and_what_is_inside) {
    for (const char* ior : {"1", "1.5", "3"}) {
        const Scene scene = scene_in_white_sky(
            "[camera]\nposition = [0, -10, 0]\nlook_at = [0, 0, 0]\nfov = 30\n"
            "[material.white]\nalbedo = [1, 1, 1]\n[material.g]\nalbedo = [1, 1, 1]\nsurface = "
            "\"glass\"\nior = " +
            std::string(ior) +
            "\n[material.h]\nalbedo = [1, 1, 1]\nsurface = \"glass\"\nior = 2\n"
            "[[sphere]]\ncenter = [0, 0, 0]\nradius = 4\nmaterial = \"g\"\n"
            "[[sphere]]\ncenter = [1, 1, 0]\nradius = 1.5\nmaterial = \"white\"\n"
            "[[sphere]]\ncenter = [-1, -2, 0]\nradius = 1.5\nmaterial = \"h\"\n");
        EXPECT_LT(std::abs(z_of(one_pixel(scene, 20000), 1.0)), kFarOff) << ior;
    }
}

// Seen from the middle of a glass ball the same sky is n^2 times as bright.
TEST(PathTruth, radiance_in_glass_is_n_squared_times_that_outside) {
    const Scene scene = scene_in_white_sky(
        "[camera]\nposition = [0, 0, 0]\nyaw = 0\npitch = 0\nfov = 60\n"
        "[material.g]\nalbedo = [1, 1, 1]\nsurface = \"glass\"\nior = 1.5\n"
        "[[sphere]]\ncenter = [0, 0, 0]\nradius = 4\nmaterial = \"g\"\n");
    EXPECT_LT(std::abs(z_of(one_pixel(scene, 10000), 2.25)), kFarOff);
}

// An emitter in the middle of a glass ball, seen straight on through it: L (1 - R) / n^2 with R = ((n - 1) /
// (n + 1))^2, since what the surface reflects ends in the emitter.
TEST(PathTruth, emitter_inside_glass_is_dimmed_by_fresnel_and_n_squared) {
    const Scene scene = dark_scene(
        "[camera]\nposition = [0, -10, 0]\nlook_at = [0, 0, 0]\nfov = 0.01\n"
        "[material.g]\nalbedo = [1, 1, 1]\nsurface = \"glass\"\nior = 2\n"
        "[material.lamp]\nalbedo = [0, 0, 0]\nemission = [9, 9, 9]\n"
        "[[sphere]]\ncenter = [0, 0, 0]\nradius = 4\nmaterial = \"g\"\n"
        "[[sphere]]\ncenter = [0, 0, 0]\nradius = 1\nmaterial = \"lamp\"\n");
    EXPECT_LT(std::abs(z_of(one_pixel(scene, 40000), 9.0 * (8.0 / 9.0) / 4.0)), kFarOff);
}

// Where one glass meets the same there is no surface: two balls that cross lose no light between them.
TEST(PathTruth, surface_between_equal_glass_does_not_show) {
    const Scene scene = scene_in_white_sky(
        "[camera]\nposition = [0, 0, 0]\nyaw = 0\npitch = 0\nfov = 0.01\n"
        "[material.g]\nalbedo = [0.5, 0.5, 0.5]\nsurface = \"glass\"\nior = 1\n"
        "[[sphere]]\ncenter = [0, 0, 0]\nradius = 4\nmaterial = \"g\"\n"
        "[[sphere]]\ncenter = [3, 0, 0]\nradius = 4\nmaterial = \"g\"\n");
    EXPECT_EQ(one_pixel(scene, 16).mean, glm::dvec3(0.5));
}

TEST(PathTruth, picture_is_a_function_of_its_seed) {
    const test::TruthWorld world = test::truth_world(hollow_ball("albedo = [0.5, 0.5, 0.5]\n"));
    const auto trace = [&](std::uint64_t seed) {
        return trace_truth_pixel(world, {.size = {4, 4}, .spp = 16, .seed = seed}, {1, 2}).mean;
    };
    EXPECT_EQ(trace(1), trace(1));
    EXPECT_NE(trace(1), trace(2));
}

struct ScenePixel {
    const char* scene;
    glm::ivec2 pixel;  // of 32 x 32
};

// Two estimators of one picture: emitters sampled, and emitters hit by chance. The pixels show the corner
// behind the mirror ball, caustics, the ceiling, and diffuse surfaces seen through glass and inside it.
TEST(PathTruth, sampled_emitters_give_what_chance_gives) {
    for (const ScenePixel& at :
         {ScenePixel{"cornell", {6, 23}}, ScenePixel{"cornell", {24, 26}}, ScenePixel{"cornell", {14, 3}},
          ScenePixel{"glass_in_glass", {24, 21}}, ScenePixel{"glass_in_glass", {8, 21}}}) {
        const test::TruthWorld world = test::truth_world(
            load_scene(std::filesystem::path(VX_SOURCE_DIR) / "scenes" / (std::string(at.scene) + ".toml")));
        const TruthPixel sampled = trace_truth_pixel(world, {.spp = 20000, .seed = 4}, at.pixel);
        const TruthPixel hit =
            trace_truth_pixel(world, {.spp = 60000, .seed = 5, .samples_emitters = false}, at.pixel);
        const double variance = sampled.variance_of_mean.x + hit.variance_of_mean.x;
        EXPECT_LT(std::abs(sampled.mean.x - hit.mean.x), kFarOff * std::sqrt(variance)) << at.pixel.x;
        EXPECT_LT(std::sqrt(variance), 0.05 * hit.mean.x) << at.scene << at.pixel.x;
    }
}

// Pixels of mean 1 and noise of a variance of 0.04, less `offset`; each estimate is a mean of 12 uniform
// numbers.
test::PictureZ z_of_noise(double offset) {
    test::TestRandom random(6);
    std::vector<TruthPixel> traced, expected;
    for (int i = 0; i < 4000; ++i) {
        TruthPixel pixel{glm::dvec3(1.0 - offset), glm::dvec3(0.04)};
        for (int c = 0; c < 3; ++c)
            for (int n = 0; n < 12; ++n)
                pixel.mean[c] += 0.2 * random.uniform(-0.5, 0.5);
        traced.push_back(pixel);
        expected.push_back({glm::dvec3(1.0), glm::dvec3(0.0)});
    }
    return test::picture_z(traced, expected);
}

TEST(PictureZ, of_noise_is_1_and_of_an_offset_is_more) {
    const test::PictureZ same = z_of_noise(0.0);
    EXPECT_NEAR(same.rms, 1.0, 0.02);
    EXPECT_LT(same.beyond_4, 0.001);
    EXPECT_LT(std::abs(same.of_mean.x), kFarOff);
    const test::PictureZ moved = z_of_noise(0.1);  // half a standard deviation
    EXPECT_NEAR(moved.rms, std::sqrt(1.25), 0.02);
    EXPECT_NEAR(moved.of_mean.x, -0.5 * std::sqrt(4000.0), kFarOff);
}

TEST(PathTruth, what_it_does_not_know_is_refused) {
    Scene lost = hollow_ball("albedo = [0.5, 0.5, 0.5]\n");
    lost.camera.reset();
    EXPECT_THROW((void)test::truth_world(lost), std::invalid_argument);
    EXPECT_THROW((void)test::truth_world(hollow_ball("surface = \"metal\"\nroughness = 0.5\n")),
                 std::invalid_argument);
}

}  // namespace
}  // namespace voxilux
