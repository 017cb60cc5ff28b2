// Directions towards the sky: their density, and the integrals that they estimate.

#include <cmath>
#include <numbers>
#include <utility>

#include <gtest/gtest.h>

#include "shared/rng.h"
#include "support/sky_model.h"

namespace voxilux {
namespace {

using glm::dvec3;
using glm::vec2;
using glm::vec3;

constexpr gpu::uint kUpFace = 5;
// Standard errors of a mean, and standard deviations of a chi-squared: the seeds are fixed.
constexpr double kSigmas = 4.0;

gpu::SkyParams sky_under(float sun_elevation_deg) {
    const gpu::Air air{
        {5.802e-3f, 13.558e-3f, 33.1e-3f}, {0.65e-3f, 1.881e-3f, 0.085e-3f}, 3.996e-3f, 4.44e-3f, 0.8f, 0.3f};
    return {.air = air,
            .height = 0.2f,
            .horizon = gpu::horizon_elevation(0.2f),
            .top = std::numbers::pi_v<float> / 2.0f,
            .disc_height = 0.0f,
            .sun_direction = test::direction_of(0.0, double{sun_elevation_deg}),
            .irradiance = vec3(1.0f),
            .resolution = 64};
}

std::vector<vec3> view_of(const gpu::SkyParams& sky) {
    static const test::ScatterTable scatter = test::scatter_table(sky.air);
    return test::view_table(scatter, sky);
}

vec2 random_point(gpu::uint i) {
    return {gpu::rng_float(11, 1, i, 0), gpu::rng_float(11, 1, i, 1)};
}

// The sum of the probabilities differs from 1 only by rounding, so each is the probability of its bin.
double chance(const std::vector<float>& shares, gpu::uint face, gpu::uint row, gpu::uint column) {
    const auto part = [&](gpu::uint first, gpu::uint number) {
        return double{shares[first + number]} - (number == 0 ? 0.0 : double{shares[first + number - 1]});
    };
    const gpu::uint first = face * gpu::kFaceShares;
    return part(first, row) * part(first + gpu::kSkyBins * (1 + row), column);
}

TEST(SkySample, bins_are_drawn_as_often_as_their_density_says) {
    constexpr gpu::uint kDraws = 400000;
    for (const float sun : {-5.0f, 0.5f, 89.0f}) {
        const gpu::SkyParams sky = sky_under(sun);
        const std::vector<float> shares = test::sky_shares(view_of(sky), sky);
        for (const gpu::uint face : {1u, 3u, kUpFace}) {
            std::vector<double> counts(gpu::kSkyBins * gpu::kSkyBins, 0.0);
            for (gpu::uint i = 0; i < kDraws; ++i) {
                const gpu::SkySample drawn = gpu::sample_sky(shares, face, random_point(i));
                ASSERT_NEAR(glm::length(drawn.direction), 1.0f, 1e-5f);
                const double z = (double{drawn.direction.z} + 1.0) / 2.0 * gpu::kSkyBins;
                double a = std::atan2(double{drawn.direction.y}, double{drawn.direction.x}) /
                           (2.0 * std::numbers::pi);
                a = (a < 0.0 ? a + 1.0 : a) * gpu::kSkyBins;
                const auto row = std::min(static_cast<gpu::uint>(z), gpu::kSkyBins - 1);
                const auto column = std::min(static_cast<gpu::uint>(a), gpu::kSkyBins - 1);
                counts[row * gpu::kSkyBins + column] += 1.0;
                // A direction on the border of two bins may be counted in either.
                const double pdf = chance(shares, face, row, column) * gpu::kSkyBins * gpu::kSkyBins /
                                   (4.0 * std::numbers::pi);
                if (i < 1000 && std::abs(z - std::round(z)) > 1e-3 && std::abs(a - std::round(a)) > 1e-3) {
                    ASSERT_NEAR(double{drawn.pdf}, pdf, 1e-3 * pdf);
                }
            }
            double chi = 0.0, freedom = -1.0;
            for (gpu::uint bin = 0; bin < counts.size(); ++bin) {
                const double expected =
                    kDraws * chance(shares, face, bin / gpu::kSkyBins, bin % gpu::kSkyBins);
                if (expected < 10.0) continue;
                chi += (counts[bin] - expected) * (counts[bin] - expected) / expected;
                freedom += 1.0;
            }
            EXPECT_GT(freedom, 500.0);
            EXPECT_NEAR(chi, freedom, kSigmas * std::sqrt(2.0 * freedom)) << sun << " face " << face;
        }
    }
}

struct Estimate {
    dvec3 mean{0.0};
    dvec3 variance{0.0};           // of one sample
    double variance_of_sum = 0.0;  // of its colours
};

Estimate estimate(const auto& draw) {
    constexpr gpu::uint kDraws = 100000;
    dvec3 sum(0.0), squares(0.0);
    double squares_of_sum = 0.0;
    for (gpu::uint i = 0; i < kDraws; ++i) {
        const dvec3 value = draw(random_point(i));
        squares_of_sum += (value.x + value.y + value.z) * (value.x + value.y + value.z);
        sum += value;
        squares += value * value;
    }
    const dvec3 mean = sum / double{kDraws};
    const double mean_of_sum = mean.x + mean.y + mean.z;
    return {mean, squares / double{kDraws} - mean * mean,
            squares_of_sum / double{kDraws} - mean_of_sum * mean_of_sum};
}

Estimate by_light(const std::vector<vec3>& view, const gpu::SkyParams& sky) {
    const std::vector<float> shares = test::sky_shares(view, sky);
    return estimate([&](vec2 u) {
        const gpu::SkySample drawn = gpu::sample_sky(shares, kUpFace, u);
        const float cosine = std::max(drawn.direction.z, 0.0f);
        return dvec3(gpu::sky_radiance(view, sky, drawn.direction) * (cosine / drawn.pdf));
    });
}

Estimate by_cosine(const std::vector<vec3>& view, const gpu::SkyParams& sky) {
    return estimate([&](vec2 u) {
        return dvec3(gpu::sky_radiance(view, sky, gpu::cosine_on_face(kUpFace, u))) * std::numbers::pi;
    });
}

TEST(SkySample, open_plane_receives_the_integral_of_the_sky_at_every_elevation_of_the_sun) {
    for (const float sun : {-5.0f, -1.0f, 0.5f, 2.0f, 10.0f, 45.0f, 89.0f}) {
        const gpu::SkyParams sky = sky_under(sun);
        const std::vector<vec3> view = view_of(sky);
        const Estimate light = by_light(view, sky), cosine = by_cosine(view, sky);
        for (int c = 0; c < 3; ++c) {
            const double error = std::sqrt((light.variance[c] + cosine.variance[c]) / 100000.0);
            EXPECT_NEAR(light.mean[c], cosine.mean[c], kSigmas * error) << sun << " colour " << c;
            EXPECT_LT(error, 0.01 * light.mean[c]) << "the test tells nothing";
        }
    }
}

TEST(SkySample, variance_under_a_low_sun_is_a_quarter_of_that_of_cosines_or_less) {
    const gpu::SkyParams sky = sky_under(5.0f);
    const std::vector<vec3> view = view_of(sky);
    const Estimate light = by_light(view, sky), cosine = by_cosine(view, sky);
    EXPECT_LT(light.variance_of_sum, 0.25 * cosine.variance_of_sum);
}

TEST(SkySample, black_sky_is_drawn_from_evenly) {
    const gpu::SkyParams sky = sky_under(-90.0f);
    const std::vector<float> shares = test::sky_shares(view_of(sky), sky);
    for (gpu::uint i = 0; i < 100; ++i)
        EXPECT_NEAR(gpu::sample_sky(shares, kUpFace, random_point(i)).pdf, 0.25f * gpu::kInversePi, 1e-5f);
}

}  // namespace
}  // namespace voxilux
