// The mathematics of the denoiser: fits, mixtures and the error estimate.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "shared/denoise.h"
#include "support/statistics.h"

namespace voxilux {
namespace {

using test::TestRandom;

TEST(DenoiseMath, light_that_is_received_is_that_reflected_over_the_albedo) {
    const glm::vec4 light = gpu::received_light({0.4f, 0.1f, 0.0f}, {0.8f, 0.2f, 0.0f});
    EXPECT_NEAR(light.x, 0.5f, 1e-6f);
    EXPECT_NEAR(light.y, 0.5f, 1e-6f);
    EXPECT_EQ(light.z, 0.0f);
    EXPECT_NEAR(light.w, 0.3131f * 0.3131f, 1e-4f);  // luminance 0.8 * 0.2126 + 0.2 * 0.7152
    EXPECT_EQ(gpu::received_light(glm::vec3(1.0f), glm::vec3(0.0f)), glm::vec4(0.0f));
}

TEST(DenoiseMath, guides_of_pixels_that_are_covered_in_part_are_those_of_their_plane) {
    const glm::vec4 whole(0.0f, 0.0f, 1.0f, -4.0f);
    const glm::vec4 guide = gpu::guide_of(0.3f * whole);
    for (int i = 0; i < 4; ++i)
        EXPECT_NEAR(guide[i], whole[i], 1e-6f);
    EXPECT_EQ(gpu::guide_of(glm::vec4(0.0f)), glm::vec4(0.0f)) << "a miss";
    EXPECT_TRUE(gpu::is_pure(whole));
    EXPECT_FALSE(gpu::is_pure({0.5f, 0.0f, 0.5f, -4.0f})) << "an edge";
    EXPECT_EQ(gpu::guide_weight(whole, whole), 1.0f);
    EXPECT_EQ(gpu::guide_weight(whole, {0.0f, 0.0f, 1.0f, -3.0f}), 0.0f) << "the next plane of voxels";
    EXPECT_EQ(gpu::guide_weight(whole, {1.0f, 0.0f, 0.0f, -4.0f}), 0.0f) << "another side";
}

TEST(DenoiseMath, slope_fit_finds_light_that_changes_evenly_from_one_side) {
    gpu::SlopeFit fit{};
    for (int i = 0; i < 15; ++i) {  // the right half of the taps only, as beside a wall
        const glm::vec2 there(static_cast<float>(i % 3) / 2.0f, static_cast<float>(i / 3 - 2) / 2.0f);
        const glm::vec3 light = glm::vec3(2.0f) + there.x * glm::vec3(1.0f) + there.y * glm::vec3(0.5f);
        fit.weight += 1.0f;
        fit.place += there;
        fit.places += glm::vec3(there.x * there.x, there.x * there.y, there.y * there.y);
        fit.light += light;
        fit.light_x += there.x * light;
        fit.light_y += there.y * light;
    }
    const float mean = fit.light.x / fit.weight;
    EXPECT_NEAR(mean, 2.5f, 1e-5f) << "the mean is off by a quarter";
    // The ridge of 0.03 takes 0.03 / (1/6 + 0.03) of the slope of the variance 1/6.
    EXPECT_NEAR(gpu::fitted_light(fit).x, 2.5f - 0.5f * (1.0f - 0.03f / (1.0f / 6.0f + 0.03f)), 1e-4f);
}

TEST(DenoiseMath, feature_fit_finds_the_light_of_a_mixture) {
    // Pixels of a floor in light 1 and a wall in light 3, and at the edge one that sees a quarter of the
    // wall.
    const glm::vec4 floor(0.0f, 0.0f, 1.0f, -5.0f), wall(1.0f, 0.0f, 0.0f, -5.0f);
    const glm::vec4 edge = glm::mix(floor, wall, 0.25f);
    gpu::FeatureFit fit{};
    for (int i = 0; i < 20; ++i) {
        const bool is_wall = i < 12;
        const glm::vec4 feature = gpu::features_of(edge, is_wall ? wall : floor);
        const glm::vec3 light(is_wall ? 3.0f : 1.0f);
        fit.weight += 1.0f;
        fit.feature += feature;
        fit.features += glm::outerProduct(feature, feature);
        fit.light += light;
        fit.red += light.x * feature;
        fit.green += light.y * feature;
        fit.blue += light.z * feature;
    }
    EXPECT_NEAR(fit.light.x / fit.weight, 2.2f, 1e-5f) << "the mean knows nothing of the edge";
    // The ridge of 0.01 takes 0.01 / (0.48 + 0.01) of the way from the mean: 0.48 is twice the variance 0.24.
    EXPECT_NEAR(gpu::featured_light(fit).x, 1.5f + 0.7f * 0.01f / 0.49f, 1e-3f);
}

double noise_of(TestRandom& random) {
    return random.uniform(0.0, 1.0) < 0.1 ? 9.0 : -1.0;  // skewed, mean 0
}

// Half means of a constant 5, filtered by shrinking towards a wrong value of 5.5.
struct Shrunk {
    glm::vec3 a, b, filtered_a, filtered_b;
};

Shrunk shrunk_draw(TestRandom& random, int of_a, int of_b) {
    const auto mean = [&](int samples) {
        double sum = 0.0;
        for (int i = 0; i < samples; ++i)
            sum += 5.0 + noise_of(random);
        return glm::vec3(static_cast<float>(sum / samples));
    };
    Shrunk draw{.a = mean(of_a), .b = mean(of_b)};
    draw.filtered_a = 0.4f * draw.a + 0.6f * glm::vec3(5.5f);
    draw.filtered_b = 0.4f * draw.b + 0.6f * glm::vec3(5.5f);
    return draw;
}

TEST(DenoiseMath, squared_error_has_no_bias) {
    for (const auto& [of_a, of_b] : {std::pair{4, 4}, {3, 2}}) {
        TestRandom random(5);
        const float share = static_cast<float>(of_a) / static_cast<float>(of_a + of_b);
        double claimed = 0.0, squares = 0.0, truth = 0.0, without = 0.0;
        constexpr int kDraws = 200000;
        for (int i = 0; i < kDraws; ++i) {
            const Shrunk draw = shrunk_draw(random, of_a, of_b);
            const auto estimate = static_cast<double>(
                gpu::squared_error(draw.filtered_a, draw.filtered_b, draw.a, draw.b, share).x);
            const double mean =
                static_cast<double>(share * draw.filtered_a.x + (1.0f - share) * draw.filtered_b.x);
            claimed += estimate / kDraws;
            squares += estimate * estimate / kDraws;
            truth += (mean - 5.0) * (mean - 5.0) / kDraws;
            without +=
                static_cast<double>((draw.filtered_a.x - draw.b.x) * (draw.filtered_a.x - draw.b.x)) / kDraws;
        }
        const double deviation = std::sqrt((squares - claimed * claimed) / kDraws);
        EXPECT_NEAR(claimed, truth, 4.0 * deviation) << of_a;
        EXPECT_GT(std::abs(without - truth), 40.0 * deviation) << "the negative control: B's own variance";
    }
}

TEST(DenoiseMath, share_is_the_one_of_least_error) {
    TestRandom random(6);
    glm::vec2 terms(0.0f);
    constexpr int kDraws = 100000;
    for (int i = 0; i < kDraws; ++i) {
        const Shrunk draw = shrunk_draw(random, 4, 4);
        terms +=
            gpu::share_terms(draw.a, draw.filtered_a, draw.b, glm::vec3(1.0f)) / static_cast<float>(kDraws);
    }
    // x = a has variance 9/4. x + s (y - x) = (1 - 0.6 s) a + 0.6 s 5.5 errs by (1 - 0.6 s)^2 9/4 + (0.3
    // s)^2: least at s = 0.6 * 9/4 / (0.36 * 9/4 + 0.09).
    EXPECT_NEAR(gpu::share_of(terms), std::min(0.6 * 2.25 / (0.36 * 2.25 + 0.09), 1.0), 0.02);
    EXPECT_EQ(gpu::share_of({1.0f, 0.0f}), 0.0f);
    EXPECT_EQ(gpu::share_of({-1.0f, 2.0f}), 0.0f);
    EXPECT_EQ(gpu::share_of({3.0f, 2.0f}), 1.0f);
}

}  // namespace
}  // namespace voxilux
