// The blur of a thin lens against its closed form.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "support/frame_fixture.h"
#include "support/test_scenes.h"

namespace voxilux {
namespace {

constexpr double kDepth = 40.0;   // of the ball, voxels
constexpr double kRadius = 1.0;   // of the ball
constexpr double kFovDeg = 40.0;  // vertical

// A ball that shines, alone in the dark, in the middle of the picture.
Scene ball(double aperture, double focus) {
    Scene scene = test::white_scene();
    scene.materials.push_back(
        {.albedo = glm::vec3(0.0f), .emission = glm::vec3(1.0f), .surface = Surface::emit});
    scene.spheres.push_back({{0, 0, 0}, kRadius, 1u});
    scene.sky.radiance = glm::vec3(0.0f);
    scene.camera = test::camera_towards({0, -kDepth, 0}, {0, 0, 0}, kFovDeg);
    scene.lens = {.aperture = aperture, .focus = focus};
    scene.settings.size = {64, 64};
    scene.settings.spp = 256;
    return scene;
}

struct Spot {
    double light = 0.0;     // sum of the pixels
    double variance = 0.0;  // of a coordinate of its light, pixels^2
};

Spot spot_of(const Scene& scene) {
    const Image image = test::render_validated(scene, {.plan = {.effects = {.wants_aov = true}}}).image;
    const std::vector<float>& light = image.channels.at("R").pixels;
    Spot spot;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            const glm::dvec2 at = glm::dvec2(x, y) + 0.5 - 0.5 * glm::dvec2(image.width, image.height);
            const double value = double{light[static_cast<std::size_t>(y * image.width + x)]};
            spot.light += value;
            spot.variance += 0.5 * value * glm::dot(at, at);
        }
    }
    spot.variance /= spot.light;
    return spot;
}

// A disc of radius r has the variance r^2 / 4 along an axis: the ball's, and the aperture's as it falls
// through a point at its depth onto the image. Where they meet in a pixel is uniform.
double variance_of(double aperture, double focus) {
    const double pixels = 64.0 / (2.0 * std::tan(kFovDeg * std::numbers::pi / 360.0));  // at distance 1
    const double ball = pixels * kRadius / kDepth;
    const double blur = pixels * 0.5 * aperture * std::abs(1.0 / focus - 1.0 / kDepth);
    return (ball * ball + blur * blur) / 4.0 + 1.0 / 12.0;
}

// Some 3,900 samples meet the ball; three standard deviations of a variance from so many points of a disc.
constexpr double kTolerance = 0.05;

TEST(Lens, blurs_as_its_aperture_and_distance_of_focus_say) {
    for (const double focus : {20.0, 40.0, 1e9}) {
        const Spot spot = spot_of(ball(8.0, focus));
        const double want = variance_of(8.0, focus);
        EXPECT_NEAR(spot.variance, want, kTolerance * want) << focus;
    }
}

TEST(Lens, another_focus_or_aperture_is_seen) {
    const double variance = spot_of(ball(8.0, 20.0)).variance;
    for (const double want : {variance_of(8.0, 21.0), variance_of(8.6, 20.0)})
        EXPECT_GT(std::abs(variance - want), kTolerance * want);
}

TEST(Lens, focus_at_infinity_behind_the_camera_and_at_the_lens_is_well_defined) {
    const double far = variance_of(8.0, 1e9);
    Scene behind = ball(8.0, 1.0);
    behind.lens = {.aperture = 8.0, .focus_at = glm::dvec3(0.0, -2.0 * kDepth, 0.0)};
    for (const Scene& scene : {ball(8.0, std::numeric_limits<double>::infinity()), behind})
        EXPECT_NEAR(spot_of(scene).variance, far, kTolerance * far);
    // The blur is thousands of times as wide as the picture.
    const double light = spot_of(ball(8.0, 1e-300)).light;
    EXPECT_TRUE(light >= 0.0 && light < 0.01 * spot_of(ball(0.0, 1.0)).light) << light;
}

// A picture changes little with a small aperture, and by no step where the lens comes in.
TEST(Lens, of_little_width_changes_little) {
    const double sharp = spot_of(ball(0.0, 20.0)).variance;
    EXPECT_NEAR(spot_of(ball(0.01, 20.0)).variance, sharp, kTolerance * sharp);
}

TEST(Lens, keeps_the_light_of_what_it_blurs) {
    const double sharp = spot_of(ball(0.0, kDepth)).light;
    EXPECT_NEAR(spot_of(ball(8.0, 20.0)).light, sharp, kTolerance * sharp);
}

TEST(Lens, switched_off_is_the_pinhole_to_the_bit) {
    const Scene scene = ball(8.0, 20.0);
    const RenderOptions off{.plan = {.effects = {.switches = {{Effect::lens, Switch::off}}}}};
    const auto pinhole = test::render_validated(ball(0.0, 20.0), RenderOptions{}).image;
    EXPECT_EQ(test::render_validated(scene, off).image.channels.at("R").pixels,
              pinhole.channels.at("R").pixels);
    EXPECT_NE(test::render_validated(scene).image.channels.at("R").pixels, pinhole.channels.at("R").pixels)
        << "negative control";
}

}  // namespace
}  // namespace voxilux
