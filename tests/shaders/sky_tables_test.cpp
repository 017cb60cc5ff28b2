// The tables of the sky for extreme parameters, and their continuity.

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <utility>

#include <gtest/gtest.h>

#include "shared/sampling.h"
#include "support/hard_airs.h"
#include "support/sky_model.h"

namespace voxilux {
namespace {

using glm::vec3;
using test::earth;
using test::hard_airs;
using test::HardAir;
using test::ScatterTable;
using test::sky_of;

const ScatterTable& earths_table() {
    static const ScatterTable scatter = test::scatter_table(earth());
    return scatter;
}

TEST(SkyTables, every_hard_case_is_finite_and_not_negative) {
    for (const HardAir& hard : hard_airs()) {
        const ScatterTable scatter = test::scatter_table(hard.air, 1);
        for (const float height : test::kHardHeights) {
            for (const float sun : test::kHardSuns) {
                for (const vec3& texel : test::view_table(scatter, sky_of(hard.air, height, sun))) {
                    for (int c = 0; c < 3; ++c) {
                        ASSERT_TRUE(std::isfinite(texel[c])) << hard.name << ' ' << height << ' ' << sun;
                        ASSERT_GE(texel[c], 0.0f) << hard.name << ' ' << height << ' ' << sun;
                    }
                }
            }
        }
    }
}

TEST(SkyTables, sun_at_the_nadir_leaves_exactly_nothing) {
    const ScatterTable& scatter = earths_table();
    for (const vec3& texel : test::view_table(scatter, sky_of(earth(), 0.2f, -90.0f)))
        ASSERT_EQ(texel, vec3(0.0f));
}

TEST(SkyTables, nothing_that_scatters_leaves_a_black_sky_over_a_sunlit_ground) {
    const gpu::Air air = hard_airs().at(3).air;
    const gpu::SkyParams sky = sky_of(air, 0.2f, 45.0f);
    const std::vector<vec3> view = test::view_table(test::scatter_table(air), sky);
    EXPECT_EQ(test::looked_up(view, sky, 30.0, 40.0), vec3(0.0f));
    EXPECT_GT(test::looked_up(view, sky, -60.0, 40.0).x, 0.02f);
}

TEST(SkyTables, zenith_looks_the_same_from_every_azimuth) {
    const ScatterTable& scatter = earths_table();
    for (const float sun : {-5.0f, 10.0f, 90.0f}) {
        const gpu::SkyParams sky = sky_of(earth(), 0.2f, sun, 64);
        const std::vector<vec3> view = test::view_table(scatter, sky);
        const vec3 up = gpu::sky_radiance(view, sky, {0.0f, 0.0f, 1.0f});
        for (const float azimuth : {0.0f, 1.0f, 2.0f, 3.1f}) {
            const vec3 near =
                gpu::sky_radiance(view, sky, {1e-4f * std::cos(azimuth), 1e-4f * std::sin(azimuth), 1.0f});
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(near[c] / up[c], 1.0f, 1e-3f) << sun << ' ' << azimuth;
        }
    }
}

TEST(SkyTables, quarter_turns_of_sun_and_view_keep_every_bit) {
    const ScatterTable& scatter = earths_table();
    gpu::SkyParams sky = sky_of(earth(), 0.2f, 12.0f, 32);
    sky.sun_direction = {0.6f * 0.978148f, 0.8f * 0.978148f, 0.207912f};
    const std::vector<vec3> view = test::view_table(scatter, sky);
    for (int i = 0; i < 500; ++i) {
        const float z = std::sin(0.37f * static_cast<float>(i)), a = 1.7f * static_cast<float>(i);
        vec3 direction(std::sqrt(1.0f - z * z) * std::cos(a), std::sqrt(1.0f - z * z) * std::sin(a), z);
        const vec3 before = gpu::sky_radiance(view, sky, direction);
        for (int turn = 0; turn < 4; ++turn) {
            direction = {-direction.y, direction.x, direction.z};
            sky.sun_direction = {-sky.sun_direction.y, sky.sun_direction.x, sky.sun_direction.z};
            ASSERT_EQ(gpu::sky_radiance(view, sky, direction), before) << i << ' ' << turn;
        }
    }
}

// Logarithms of the mean radiance of the dome at equal steps of the sun's elevation.
std::vector<double> dome_means(const ScatterTable& scatter) {
    std::vector<double> means;
    for (int i = 0; i < 200; ++i) {
        const gpu::SkyParams sky = sky_of(earth(), 0.2f, -8.0f + 98.0f * static_cast<float>(i) / 199.0f);
        const std::vector<vec3> view = test::view_table(scatter, sky);
        double sum = 0.0;
        for (gpu::uint k = gpu::kFaceRays / 2; k < gpu::kFaceRays; ++k) {
            const gpu::FaceRay ray = gpu::face_ray(sky, k);
            const vec3 radiance = gpu::sky_radiance(view, sky, ray.direction);
            sum += static_cast<double>(ray.weight * (radiance.x + radiance.y + radiance.z));
        }
        means.push_back(std::log(sum));
    }
    return means;
}

double largest_jump(const std::vector<double>& values) {
    double largest = 0.0;
    for (std::size_t i = 1; i + 1 < values.size(); ++i)
        largest = std::max(largest, std::abs(values[i + 1] - 2.0 * values[i] + values[i - 1]));
    return largest;
}

// The truth bends by up to 0.05 in a step, where the sun sets.
constexpr double kLargestBend = 0.08;

TEST(SkyTables, two_hundred_elevations_of_the_sun_pass_without_a_jump) {
    std::vector<double> means = dome_means(earths_table());
    EXPECT_LT(largest_jump(means), kLargestBend);
    for (std::size_t i = 1; i < means.size() / 2; ++i)
        EXPECT_GT(means[i], means[i - 1]) << i;  // a higher sun, more light
    means[100] += 0.05;                          // a jump of 5 %
    EXPECT_GT(largest_jump(means), kLargestBend);
}

TEST(SkyTables, altitude_changes_the_zenith_without_a_jump) {
    const ScatterTable& scatter = earths_table();
    std::vector<double> zenith;
    for (int i = 0; i <= 198; ++i) {  // to 99 km: the zenith of the top is black
        const float height = 0.5f * static_cast<float>(i);
        const gpu::AirRay ray{height, 1.0f, std::sqrt(0.5f), std::sqrt(0.5f)};
        const gpu::AirLight light = gpu::march_air(scatter, earth(), ray, 4u, true);
        zenith.push_back(std::log(static_cast<double>(light.rayleigh.y * 0.08f + light.multiple.y)));
    }
    for (std::size_t i = 1; i < zenith.size(); ++i) {
        EXPECT_LT(zenith[i], zenith[i - 1]) << i;
        if (i + 1 < 180) {
            EXPECT_LT(std::abs(zenith[i + 1] - 2.0 * zenith[i] + zenith[i - 1]), 0.02) << i;
        }
    }
}

TEST(SkyTables, rounds_converge) {
    const gpu::SkyParams sky = sky_of(earth(), 0.2f, 30.0f);
    const gpu::AirRay ray = test::air_ray(sky, 20.0, 90.0);
    const auto multiple = [&](gpu::uint rounds) {
        return gpu::march_air(test::scatter_table(earth(), rounds), earth(), ray, 4u, true).multiple.z;
    };
    const float few = multiple(0), some = multiple(2), most = multiple(6);
    EXPECT_LT(std::abs(some / most - 1.0f), 0.03f);
    EXPECT_GT(std::abs(few / most - 1.0f), std::abs(some / most - 1.0f));
}

TEST(SunDisc, irradiance_is_that_of_the_sun_and_the_limb_is_darker) {
    gpu::Air none = hard_airs().at(3).air;
    none.ozone = vec3(0.0f);
    const gpu::SkyParams sky = sky_of(none, 0.2f, 40.0f);
    glm::dvec3 sum(0.0);
    constexpr int kRings = 2000;
    const glm::vec3 side(0.0f, 1.0f, 0.0f);
    for (int i = 0; i < kRings; ++i) {
        const double share = (i + 0.5) / kRings;  // of the disc's area
        const double a = 0.00465 * std::sqrt(share);
        const vec3 direction =
            glm::vec3(glm::dvec3(sky.sun_direction) * std::cos(a) + glm::dvec3(side) * std::sin(a));
        sum += glm::dvec3(gpu::sun_disc_radiance(sky, direction)) *
               (2.0 * std::numbers::pi * double{sky.disc_height} / kRings);
    }
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(sum[c], 1.0, 2e-3);
    const vec3 outside = gpu::sun_disc_radiance(sky, glm::normalize(sky.sun_direction + 0.005f * side));
    EXPECT_EQ(outside, vec3(0.0f));
    const vec3 rim = gpu::sun_disc_radiance(sky, glm::normalize(sky.sun_direction + 0.0045f * side));
    EXPECT_LT(rim.z / rim.x, gpu::sun_disc_radiance(sky, sky.sun_direction).z /
                                 gpu::sun_disc_radiance(sky, sky.sun_direction).x);
}

TEST(SunDisc, planet_hides_what_is_below_its_horizon) {
    const gpu::SkyParams sky = sky_of(earth(), 0.0f, 0.0f);
    EXPECT_EQ(gpu::sun_disc_radiance(sky, {1.0f, 0.0f, -0.002f}), vec3(0.0f));
    EXPECT_GT(gpu::sun_disc_radiance(sky, {1.0f, 0.0f, 0.002f}).x, 1.0f);
}

}  // namespace
}  // namespace voxilux
