// Whole renders of a plane whose radiance is known in closed form.

#include <gtest/gtest.h>

#include <numbers>

#include "support/frame_fixture.h"
#include "support/test_scenes.h"

namespace voxilux {
namespace {

// Relative. Four float roundings of the products, and the film's 2^-25 at values above 0.01.
constexpr double kRadianceError = 4.0 * 0x1p-24 + 0x1p-25 / 0.01;
// Standard deviations of a mean of thousands of samples; 1 in 16,000 by chance, and the seeds are fixed.
constexpr double kSigmas = 4.0;

// albedo (sky + irradiance cosine / pi), the cosine of a cap of half angle r being sin(elevation) (1 + cos r)
// / 2.
glm::dvec3 closed_form(const Scene& scene) {
    const double half = std::numbers::pi / 360.0;
    const double r = static_cast<double>(scene.sun.angular_diameter_deg) * half;
    const double cosine = static_cast<double>(scene.sun.direction().z) * (1.0 + std::cos(r)) / 2.0;
    const glm::dvec3 direct = glm::dvec3(scene.sun.irradiance) * cosine / std::numbers::pi;
    return glm::dvec3(scene.materials[0].albedo) * (glm::dvec3(scene.sky.radiance) + direct);
}

struct Mean {
    double value = 0.0;
    double deviation = 0.0;  // of the mean
};

Mean mean_of(const std::vector<float>& pixels) {
    double sum = 0.0;
    double squares = 0.0;
    const auto n = static_cast<double>(pixels.size());
    for (const float pixel : pixels)
        sum += static_cast<double>(pixel);
    for (const float pixel : pixels)
        squares += (static_cast<double>(pixel) - sum / n) * (static_cast<double>(pixel) - sum / n);
    return {sum / n, std::sqrt(squares / (n - 1.0) / n)};
}

constexpr std::array<const char*, 3> kColours = {"R", "G", "B"};

TEST(AnalyticPlane, under_sky_and_hard_sun_every_pixel_is_the_closed_form_and_the_error_estimate_zero) {
    const Scene scene = test::lit_plane(0.0f);
    const RenderOutcome outcome = test::render_validated(scene);
    const glm::dvec3 want = closed_form(scene);
    for (int c = 0; c < 3; ++c) {
        for (const float pixel : outcome.image.channels.at(kColours[static_cast<std::size_t>(c)]).pixels)
            ASSERT_NEAR(static_cast<double>(pixel), want[c], kRadianceError * want[c]);
    }
    EXPECT_LT(outcome.statistics.error.estimate, 1e-6);
    EXPECT_EQ(outcome.statistics.work.at("primary_rays"), 32u * 32u * 8u);
}

TEST(AnalyticPlane, under_a_soft_sun_the_mean_is_the_closed_form) {
    for (const Sequence sequence : {Sequence::white, Sequence::sobol, Sequence::halton}) {
        Scene scene = test::lit_plane(24.0f);
        scene.settings.sequence = sequence;
        const RenderOutcome outcome = test::render_validated(scene);
        const glm::dvec3 want = closed_form(scene);
        for (int c = 0; c < 3; ++c) {
            const Mean mean =
                mean_of(outcome.image.channels.at(kColours[static_cast<std::size_t>(c)]).pixels);
            EXPECT_NEAR(mean.value, want[c], kSigmas * mean.deviation + kRadianceError * want[c]);
        }
    }
}

TEST(AnalyticPlane, mean_under_a_soft_sun_rejects_an_elevation_half_a_degree_off) {
    const Scene scene = test::lit_plane(24.0f);
    Scene moved = scene;
    moved.sun.elevation_deg += 0.5f;
    const Mean mean = mean_of(test::render_validated(moved).image.channels.at("R").pixels);
    EXPECT_GT(std::abs(mean.value - closed_form(scene).x), 2.0 * kSigmas * mean.deviation);
}

// Sky, sun and emission add up: the picture of all three is the sum of the pictures of each.
TEST(AnalyticPlane, light_is_additive) {
    Scene all = test::lit_plane(24.0f);
    all.materials[0].emission = glm::vec3(0.25f);
    const auto red_of = [](const Scene& scene) {
        return test::render_validated(scene).image.channels.at("R").pixels;
    };
    Scene sky = all;
    sky.sun.on = false;
    sky.materials[0].emission = glm::vec3(0.0f);
    Scene sun = all;
    sun.sky.radiance = glm::vec3(0.0f);
    sun.materials[0].emission = glm::vec3(0.0f);
    const std::vector<float> whole = red_of(all);
    const std::vector<float> of_sky = red_of(sky);
    const std::vector<float> of_sun = red_of(sun);
    for (std::size_t i = 0; i < whole.size(); ++i)
        ASSERT_NEAR(static_cast<double>(whole[i]), static_cast<double>(of_sky[i] + of_sun[i] + 0.25f), 1e-6);
}

}  // namespace
}  // namespace voxilux
