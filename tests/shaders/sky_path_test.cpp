// Paths through the air: what they draw, against closed forms, and what they bring where parameters are
// extreme.

#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "shared/sky_path.h"
#include "support/hard_airs.h"
#include "support/mean_colour.h"

namespace voxilux {
namespace {

using glm::dvec3;
using glm::vec3;

// Standard errors of a mean: 1 in 16,000 by chance, and the seeds are fixed.
constexpr double kPathSigmas = 4.0;

test::MeanColour mean_light(const gpu::Air& air, const gpu::AirRay& ray, int paths) {
    test::MeanColour mean;
    for (int i = 0; i < paths; ++i)
        mean.add(gpu::traced_light(air, ray, gpu::kWholeRay,
                                   gpu::air_noise({1, static_cast<gpu::uint>(i), 2}, 0)));
    return mean;
}

// The mean of a function of drawn cosines, and its integral over the density that they ought to have.
struct Drawn {
    double mean = 0.0;
    double integral = 0.0;
};

Drawn drawn_cosines(const std::function<float(float)>& cosine, const std::function<float(float)>& phase,
                    const std::function<double(double)>& value) {
    constexpr int kCount = 200'000;
    Drawn drawn;
    for (int i = 0; i < kCount; ++i) {
        const double u = (i + 0.5) / kCount, c = 2.0 * u - 1.0;
        drawn.mean += value(double{cosine(static_cast<float>(u))}) / kCount;
        drawn.integral +=
            2.0 * std::numbers::pi * double{phase(static_cast<float>(c))} * value(c) * 2.0 / kCount;
    }
    return drawn;
}

TEST(SkyPath, cosines_of_scattering_have_the_density_of_their_phase_functions) {
    const auto values = {+[](double) { return 1.0; }, +[](double c) { return c; },
                         +[](double c) { return c * c; }, +[](double c) { return c > 0.3 ? 1.0 : 0.0; }};
    for (const auto& value : values) {
        const Drawn air = drawn_cosines(gpu::rayleigh_cosine, gpu::rayleigh_phase, value);
        EXPECT_NEAR(air.mean, air.integral, 1e-4);
        for (const float g : {-0.9f, -0.3f, 0.0f, 0.0005f, 0.01f, 0.8f}) {
            const auto cosine = [g](float u) { return gpu::henyey_cosine(g, u); };
            const auto phase = [g](float c) { return gpu::henyey_phase(g, c); };
            const Drawn aerosol = drawn_cosines(cosine, phase, value);
            EXPECT_NEAR(aerosol.mean, aerosol.integral, 1e-3) << g;
        }
    }
    // Another density is told apart.
    const auto square = [](double c) { return c * c; };
    const Drawn wrong =
        drawn_cosines([](float u) { return gpu::henyey_cosine(0.5f, u); }, gpu::rayleigh_phase, square);
    EXPECT_GT(std::abs(wrong.mean - wrong.integral), 0.01);
}

TEST(SkyPath, thin_air_scatters_its_column_times_its_phase_function) {
    gpu::Air air = test::earth();
    constexpr float kThin = 1e-4f;
    air.rayleigh *= kThin, air.mie = air.mie_extinction = 0.0f, air.ozone = vec3(0.0f);
    air.ground_albedo = 0.0f;
    const double column = 8.0 * (1.0 - std::exp(-100.0 / 8.0));
    for (const float sun : {0.1f, 0.5f, 1.0f}) {
        const test::MeanColour found = mean_light(air, {0.0f, 1.0f, sun, sun}, 20'000);
        for (int c = 0; c < 3; ++c) {
            const double expected = double{air.rayleigh[c]} * column * double{gpu::rayleigh_phase(sun)};
            // 0.1 %: of the light that is lost on the way and scattered twice.
            EXPECT_NEAR(found.mean()[c], expected, kPathSigmas * found.error()[c] + 1e-3 * expected) << sun;
            EXPECT_LT(found.error()[c], 2e-3 * expected) << "the test tells nothing";
        }
    }
}

// Between a white ground and thin air, the ground sends up what it receives.
TEST(SkyPath, ground_reflects_sunlight_by_its_albedo) {
    gpu::Air air = test::earth();
    air.rayleigh = air.ozone = vec3(0.0f);
    air.mie = air.mie_extinction = 0.0f;
    air.ground_albedo = 0.6f;
    const test::MeanColour found = mean_light(air, {0.2f, -1.0f, 0.5f, -0.5f}, 10);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(found.mean()[c], 0.6 * 0.5 / std::numbers::pi, 1e-4);
}

TEST(SkyPath, light_of_two_parts_of_a_ray_is_that_of_the_whole) {
    const gpu::Air air = test::earth();
    const gpu::AirRay ray{0.2f, 0.1f, 0.3f, 0.2f};
    constexpr float kCut = 20.0f;
    const gpu::AirRay rest = gpu::ray_after(ray, kCut);
    const vec3 passes = gpu::passes_from(air, ray, gpu::way_of(ray), kCut, rest.height, rest.cosine);
    test::MeanColour whole, parts, first;
    for (gpu::uint i = 0; i < 20'000; ++i) {
        const auto light = [&](const gpu::AirRay& of, float length, gpu::uint number) {
            return gpu::traced_light(air, of, length, gpu::air_noise({3, i, 4}, number));
        };
        whole.add(light(ray, gpu::kWholeRay, 0));
        first.add(light(ray, kCut, 1));
        parts.add(light(ray, kCut, 2) + passes * light(rest, gpu::kWholeRay, 3));
    }
    for (int c = 0; c < 3; ++c) {
        const double tolerance = kPathSigmas * std::hypot(whole.error()[c], parts.error()[c]);
        EXPECT_NEAR(parts.mean()[c], whole.mean()[c], tolerance);
        EXPECT_GT(std::abs(first.mean()[c] - whole.mean()[c]), 5.0 * tolerance) << "the test tells nothing";
    }
}

TEST(SkyPath, every_hard_case_is_finite_and_not_negative) {
    for (const test::HardAir& hard : test::hard_airs()) {
        for (const float height : test::kHardHeights) {
            for (const float sun_deg : test::kHardSuns) {
                const gpu::SkyParams sky = test::sky_of(hard.air, height, sun_deg);
                for (gpu::uint i = 0; i < 100; ++i) {
                    const float z = std::sin(0.37f * static_cast<float>(i));
                    const float reach = std::sqrt(1.0f - z * z), a = 1.7f * static_cast<float>(i);
                    const vec3 direction = i == 0   ? vec3(0.0f, 0.0f, 1.0f)
                                           : i == 1 ? vec3(1.0f, 0.0f, 0.0f)
                                                    : vec3(reach * std::cos(a), reach * std::sin(a), z);
                    const vec3 light = gpu::traced_sky(sky, direction, gpu::air_noise({i, 7, 1}, 0));
                    for (int c = 0; c < 3; ++c) {
                        ASSERT_TRUE(std::isfinite(light[c])) << hard.name << ' ' << height << ' ' << sun_deg;
                        ASSERT_GE(light[c], 0.0f) << hard.name << ' ' << height << ' ' << sun_deg;
                        if (sun_deg == -90.0f && height < 1.0f) {
                            ASSERT_EQ(light[c], 0.0f) << hard.name;
                        }
                    }
                }
            }
        }
    }
}

TEST(SkyPath, numbers_of_the_sample_decide_the_path) {
    const gpu::Air air = test::earth();
    const gpu::AirRay ray{0.2f, 0.5f, 0.5f, 0.5f};
    const auto light = [&](gpu::SampleKey key, gpu::uint number) {
        return gpu::traced_light(air, ray, gpu::kWholeRay, gpu::air_noise(key, number));
    };
    const vec3 one = light({1, 2, 3}, 4);
    EXPECT_EQ(light({1, 2, 3}, 4), one);
    for (const vec3 other :
         {light({0, 2, 3}, 4), light({1, 0, 3}, 4), light({1, 2, 0}, 4), light({1, 2, 3}, 0)})
        EXPECT_NE(other, one);
}

}  // namespace
}  // namespace voxilux
