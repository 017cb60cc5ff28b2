// Rough metal and rough glass in images: furnaces, and radiances by quadrature in double.

#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include <gtest/gtest.h>

#include "passes/specular/rough_gains.h"
#include "scene/technique_choice.h"
#include "shared/bsdf.h"
#include "support/frame_fixture.h"
#include "support/light_pictures.h"
#include "support/light_scenes.h"

namespace voxilux {
namespace {

using glm::dvec3;
using test::LightPicture;
using test::TruthPixel;

constexpr double kPi = std::numbers::pi;
constexpr double kFarOff = 4.0;  // standard deviations

Scene rough_scene(int pixels) {
    Scene scene = test::dark_scene(pixels, 1024, 1.0);
    choose_technique("indirect", "auto", scene.settings);
    choose_technique("caustics", "auto", scene.settings);
    return scene;
}

std::uint16_t add_metal(Scene& scene, float roughness, glm::vec3 albedo) {
    return test::add_material(scene, {.name = "metal",
                                      .albedo = albedo,
                                      .surface = Surface::metal,
                                      .roughness = roughness,
                                      .metallic = 1.0f});
}

std::uint16_t add_frosted(Scene& scene, float roughness, float ior) {
    const std::uint16_t glass = test::add_glass(scene, ior);
    scene.materials[glass].roughness = roughness;
    return glass;
}

// The mean of the whole picture.
TruthPixel mean_of(const Scene& scene, std::uint32_t samples) {
    const std::array blocks{scene.settings.size.x};
    return test::render_light(scene, {samples, blocks, {}}).front().pixels.front();
}

// `error`: of the expected radiance, relative.
void expect_radiance(const TruthPixel& pixel, dvec3 expected, double error) {
    for (int c = 0; c < 3; ++c) {
        const double noise = std::sqrt(pixel.variance_of_mean[c]);
        EXPECT_LT(noise, 0.02 * expected[c]) << "too few samples";
        EXPECT_NEAR(pixel.mean[c], expected[c], kFarOff * noise + error * expected[c]) << c;
    }
}

// White balls, blocks, and blocks with balls in them, under a white sky: nothing is lost but what gains err.
TEST(RoughForms, white_metal_and_glass_under_a_white_sky_are_white) {
    for (const float roughness : {0.02f, 0.3f, 0.6f, 1.0f}) {
        Scene scene = rough_scene(16);
        scene.sky.radiance = glm::vec3(1.0f);
        const std::uint16_t metal = add_metal(scene, roughness, glm::vec3(1.0f));
        const std::uint16_t glass = add_frosted(scene, roughness, 1.5f);
        test::add_box(scene, {-4, -4, -1}, {4, 4, 0}, metal);
        test::add_box(scene, {-3, -1, 0}, {-1, 1, 3}, glass);
        scene.spheres.push_back({{1.5, 0.0, 1.5}, 1.25, glass});
        scene.spheres.push_back({{0.0, 2.0, 1.0}, 1.0, metal});
        scene.camera = test::camera_towards({-6, -8, 7}, {0, 0, 1}, 40.0);
        // Paths meet several surfaces, each of which may gain or lose 0.5 %.
        expect_radiance(mean_of(scene, 32), dvec3(1.0), 0.015);
    }
}

TEST(RoughForms, plan_shows_rough_surfaces_by_paths_and_only_those) {
    Scene scene = rough_scene(8);
    const std::uint16_t metal = add_metal(scene, 0.5f, glm::vec3(1.0f));
    scene.sky.radiance = glm::vec3(1.0f);
    test::add_box(scene, {-4, -4, -1}, {4, 4, 0}, metal);
    const RenderPlan plan = test::FrameFixture(scene, PlanRequest{}).plan();
    EXPECT_TRUE(plan.shows_rough && plan.has(Effect::specular) && !plan.has(Effect::caustics));
    EXPECT_TRUE(plan.is_by_paths(Effect::indirect));
    scene.materials[metal].roughness = 0.0f;
    EXPECT_FALSE(test::FrameFixture(scene, PlanRequest{}).plan().shows_rough);
}

// What a metal plane z = 0 of this roughness sends towards `outward` of the light from `inward`, per radiance
// and solid angle: GGX in double, the gains of the renderer.
struct MetalPlane {
    double alpha;
    dvec3 albedo;
    std::vector<float> row;

    [[nodiscard]] double gain(double cosine) const {
        const double place = double{gpu::gain_place(float(cosine), float(alpha))} * (gpu::kGainPlaces - 1);
        const auto low = std::min(static_cast<std::size_t>(place), std::size_t{gpu::kGainPlaces - 2});
        return std::lerp(double{row[low]}, double{row[low + 1]}, place - double(low));
    }

    [[nodiscard]] dvec3 operator()(dvec3 outward, dvec3 inward) const {
        const double a2 = alpha * alpha;
        const dvec3 h = glm::normalize(outward + inward);
        const double density = a2 / (kPi * std::pow(h.z * h.z * (a2 - 1.0) + 1.0, 2.0));
        const auto root = [&](double c) { return std::sqrt(a2 + (1.0 - a2) * c * c); };
        const double value =
            density * inward.z / 2.0 / (root(outward.z) * inward.z + root(inward.z) * outward.z);
        return albedo * value * (1.0 + albedo * (gain(outward.z) * gain(inward.z) - 1.0));
    }
};

MetalPlane metal_plane(double roughness, dvec3 albedo) {
    const float alpha = gpu::rough_alpha(float(roughness));
    return {double{alpha}, albedo, rough_gains(alpha, 0.0f)};
}

const dvec3 kGold(0.9, 0.7, 0.3);
constexpr std::uint32_t kIterations = 128;  // of 64 pixels that show the same point
const dvec3 kEye(-6.0, 0.0, 4.0);

// A camera that sees the origin, on a plane of gold.
Scene gold_floor(float roughness) {
    Scene scene = rough_scene(8);
    test::add_box(scene, {-40, -40, -1}, {40, 40, 0}, add_metal(scene, roughness, glm::vec3(kGold)));
    scene.camera = test::camera_towards(kEye, {0, 0, 0}, 0.02);
    return scene;
}

// The top of an emitting wall in the mirror's direction, by the midpoint rule.
dvec3 radiance_of_wall(double roughness) {
    const MetalPlane plane = metal_plane(roughness, kGold);
    const dvec3 outward = glm::normalize(kEye);
    constexpr int kParts = 400;
    dvec3 sum(0.0);
    for (int i = 0; i < kParts; ++i) {
        for (int k = 0; k < kParts; ++k) {
            const dvec3 point(5.0, 6.0 * ((i + 0.5) / kParts - 0.5), 1.0 + 4.0 * (k + 0.5) / kParts);
            const double square = glm::dot(point, point);
            const dvec3 inward = point / std::sqrt(square);
            sum += plane(outward, inward) * (inward.x / square * 24.0 / (kParts * kParts));
        }
    }
    return 4.0 * sum;
}

Scene wall_over_gold(float roughness) {
    Scene scene = gold_floor(roughness);
    test::add_box(scene, {5, -3, 1}, {6, 3, 5}, test::add_emitter(scene, 4.0f));
    return scene;
}

TEST(RoughForms, emitting_wall_is_seen_in_rough_gold_as_by_quadrature) {
    for (const float roughness : {0.1f, 0.4f, 0.8f})
        expect_radiance(mean_of(wall_over_gold(roughness), kIterations), radiance_of_wall(double{roughness}),
                        1e-3);
}

TEST(RoughForms, gold_that_is_five_percent_rougher_is_caught) {
    const TruthPixel pixel = mean_of(wall_over_gold(0.4f), kIterations);
    const dvec3 other = radiance_of_wall(0.42);
    EXPECT_GT(std::abs(pixel.mean.x - other.x),
              kFarOff * std::sqrt(pixel.variance_of_mean.x) + 1e-3 * other.x);
}

// Aimed rays bring most of the light of a small sun, sampled directions that of a large one.
TEST(RoughForms, sun_is_seen_in_rough_gold_as_by_quadrature) {
    for (const double diameter : {0.5, 20.0}) {
        for (const float roughness : {0.1f, 0.5f}) {
            Scene scene = gold_floor(roughness);
            scene.sun = {.azimuth_deg = 4.0f,
                         .elevation_deg = 35.0f,
                         .angular_diameter_deg = float(diameter),
                         .irradiance = glm::vec3(2.0f)};
            const dvec3 sun(scene.sun.direction());
            const MetalPlane plane = metal_plane(double{roughness}, kGold);
            const double height = 1.0 - std::cos(0.5 * diameter * kPi / 180.0);
            const dvec3 side = glm::normalize(glm::cross(sun, dvec3(0.0, 0.0, 1.0)));
            const dvec3 up = glm::cross(side, sun);
            constexpr int kParts = 200;
            dvec3 expected(0.0);
            for (int i = 0; i < kParts; ++i) {
                for (int k = 0; k < kParts; ++k) {
                    const double h = height * (i + 0.5) / kParts, turn = 2.0 * kPi * (k + 0.5) / kParts;
                    const double r = std::sqrt(h * (2.0 - h));
                    const dvec3 inward = (1.0 - h) * sun + r * (std::cos(turn) * side + std::sin(turn) * up);
                    expected += 2.0 * plane(glm::normalize(kEye), inward) / double(kParts * kParts);
                }
            }
            expect_radiance(mean_of(scene, kIterations), expected, 1e-3);
        }
    }
}

// A diffuse floor under a sky, lit by way of rough gold and frosted glass, with the least roughness and
// without: images differ by noise alone.
TEST(RoughFormsNightly, least_roughness_gives_the_image_of_the_smooth_surface) {
    const auto picture = [](float roughness) {
        Scene scene = rough_scene(16);
        choose_technique("indirect", "paths", scene.settings);
        choose_technique("caustics", "paths", scene.settings);
        scene.sky.radiance = {0.5f, 0.7f, 1.0f};
        test::add_box(scene, {-5, -5, -1}, {5, 5, 0}, test::add_diffuse(scene, 0.6f));
        test::add_box(scene, {-4, 3, 0}, {4, 4, 4}, add_metal(scene, roughness, glm::vec3(kGold)));
        test::add_box(scene, {1, -2, 0}, {3, 0, 2}, add_frosted(scene, roughness, 1.5f));
        scene.spheres.push_back({{-2.0, -1.0, 1.5}, 1.5, add_frosted(scene, roughness, 1.5f)});
        test::add_box(scene, {-1, -4, 0}, {1, -3, 1}, test::add_emitter(scene, 2.0f));
        scene.camera = test::camera_towards({-7, -9, 7}, {0, 0, 1}, 40.0);
        const std::array blocks{4};
        return test::render_light(scene, {64, blocks, {}}).front();
    };
    const LightPicture smooth = picture(0.0f);
    test::expect_equal_light(picture(0.01f), smooth, "least_roughness");
    EXPECT_FALSE(test::is_equal_light(picture(0.6f), smooth)) << "negative control";
}

}  // namespace
}  // namespace voxilux
