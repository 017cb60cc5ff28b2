#include "shared/sppm.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "shared/rng.h"
#include "support/statistics.h"

namespace voxilux {
namespace {

using glm::dvec3;
using glm::vec2;
using glm::vec3;

constexpr double kSppmPi = std::numbers::pi;

TEST(PhotonRadius, follows_the_recurrence_of_the_paper) {
    for (const double alpha : {0.1, 2.0 / 3.0, 0.9, 1.0}) {
        double square = 4.0;
        for (std::uint32_t i = 1; i <= 100000; ++i) {
            if (i > 1) square *= (i - 1.0 + alpha) / i;
            if (i > 3 && i % 997 != 0) continue;
            const double want = std::max(std::sqrt(square), double(gpu::kMinPhotonRadius));
            ASSERT_NEAR(gpu::photon_radius(2.0, alpha, i) / want, 1.0, 1e-9) << alpha << ' ' << i;
        }
    }
    EXPECT_EQ(gpu::photon_radius(2.0, 2.0 / 3.0, 1), 2.0);
}

// log r against log i has the slope (alpha - 1) / 2: the variance of the mean then falls as i^-alpha.
TEST(PhotonRadius, slope_is_the_published_one_and_never_rises) {
    for (const double alpha : {0.5, 2.0 / 3.0, 0.8}) {
        const double decades =
            std::log10(gpu::photon_radius(1e6, alpha, 100000000) / gpu::photon_radius(1e6, alpha, 1000000));
        EXPECT_NEAR(decades / 2.0, (alpha - 1.0) / 2.0, 1e-6);
        for (std::uint32_t i = 1; i < 100000; i += 7)
            ASSERT_LT(gpu::photon_radius(2.0, alpha, i + 1), gpu::photon_radius(2.0, alpha, i));
    }
    EXPECT_EQ(gpu::photon_radius(2.0, 0.1, 0xFFFFFFFFu), double(gpu::kMinPhotonRadius));
    EXPECT_NEAR(gpu::photon_radius(2.0, 1.0, 0xFFFFFFFFu), 2.0, 1e-6);
}

// Negative control: (i + alpha) / (i + 1) begun one iteration late is outside the tolerance of the first
// test.
TEST(PhotonRadius, index_off_by_one_is_caught) {
    const double late = gpu::photon_radius(2.0, 2.0 / 3.0, 1001) / gpu::photon_radius(2.0, 2.0 / 3.0, 1000);
    EXPECT_GT(std::abs(late - 1.0), 1e-4);
}

TEST(PhotonKernel, integrates_to_1_over_the_disc_and_stays_finite) {
    for (const float radius : {gpu::kMinPhotonRadius, 0.5f, 2.0f, 1000.0f}) {
        double sum = 0.0;
        constexpr int kRings = 1000;
        for (int ring = 0; ring < 2 * kRings; ++ring) {
            const double distance = (ring + 0.5) / kRings * double(radius);
            const double area = 2.0 * kSppmPi * distance * double(radius) / kRings;
            sum += area * double(gpu::photon_kernel(static_cast<float>(distance * distance), radius));
        }
        EXPECT_NEAR(sum, 1.0, 1e-5) << radius;
        EXPECT_TRUE(std::isfinite(gpu::photon_kernel(0.0f, radius)));
    }
}

// Mean of throughput / survival over all 2^24 values that u can take: the throughput itself.
TEST(Roulette, is_unbiased_down_to_the_smallest_throughput) {
    for (const float largest :
         {1e-38f, 1e-20f, 3e-8f, 1e-7f, 0.001f, 0.3f, 0.75f, 0.99999994f, 1.0f, 20.0f}) {
        const vec3 throughput(0.5f * largest, largest, 0.0f);
        const float survival = gpu::roulette_survival(throughput);
        ASSERT_GT(survival, 0.0f);
        ASSERT_LE(survival, 1.0f);
        const double survivors = std::ceil(double(survival) * 0x1p24);  // of u = k 2^-24 < survival
        EXPECT_EQ(survivors * 0x1p-24, double(survival)) << largest;
        EXPECT_GE(double(survival), std::min(1.0, double(largest)));
    }
    // Negative control: the throughput itself.
    EXPECT_NE(std::ceil(double(3e-8f) * 0x1p24) * 0x1p-24, double(3e-8f));
}

TEST(Roulette, ends_dead_paths_and_leaves_faults_to_be_counted) {
    const float inf = std::numeric_limits<float>::infinity();
    EXPECT_EQ(gpu::roulette_survival(vec3(0.0f)), 0.0f);
    EXPECT_EQ(gpu::roulette_survival(vec3(-1.0f)), 0.0f);
    EXPECT_EQ(gpu::roulette_survival(vec3(0.1f, inf, 0.0f)), 1.0f);
    EXPECT_EQ(gpu::roulette_survival(vec3(std::nanf(""))), 1.0f);
}

vec2 draw(std::uint32_t index, std::uint32_t dimension) {
    return {gpu::rng_float(9, 1, index, dimension), gpu::rng_float(9, 1, index, dimension + 1)};
}

// 8 bins of the height of the normal, which Archimedes makes equally likely, times 8 of the squared cosine of
// the direction, equally likely by Lambert's law. `bend` is the exponent that the cosines are raised to.
double emission_chi_square(double bend) {
    constexpr int kDraws = 200000;
    std::vector<std::uint64_t> seen(64, 0);
    for (std::uint32_t i = 0; i < kDraws; ++i) {
        const gpu::SphereEmission emission = gpu::sphere_emission(draw(i, 0), draw(i, 2));
        EXPECT_NEAR(glm::length(dvec3(emission.normal)), 1.0, 2.0 * double(gpu::kUnitLengthError));
        const double cosine = glm::dot(dvec3(emission.normal), dvec3(emission.direction));
        EXPECT_GT(cosine, 0.0);
        const auto bin = [](double part) { return std::clamp(static_cast<int>(8.0 * part), 0, 7); };
        const int cell = 8 * bin(0.5 + 0.5 * double(emission.normal.z)) + bin(std::pow(cosine, bend));
        ++seen[static_cast<std::size_t>(cell)];
    }
    return test::chi_square(seen, std::vector<double>(64, kDraws / 64.0));
}

TEST(SphereEmission, is_lambertian_and_uniform_over_the_sphere) {
    EXPECT_LT(emission_chi_square(2.0), test::chi_square_critical_99(63));
}

// As if directions were uniform over the hemisphere.
TEST(SphereEmission, emission_without_the_cosine_is_caught) {
    EXPECT_GT(emission_chi_square(1.0), test::chi_square_critical_99(63));
}

// Irradiance at a near point, from photons that cross a small disc there: the field of a Lambertian ball, pi
// L (r / d)^2. A wrong distribution of directions can keep the power, but fails here.
TEST(SphereEmission, near_field_is_that_of_a_lambertian_ball) {
    constexpr std::uint32_t kPhotons = 400000;
    const double distance = 1.5, disc = 0.25;  // radius of the ball 1, of the disc
    double hits = 0.0;
    for (std::uint32_t i = 0; i < kPhotons; ++i) {
        const gpu::SphereEmission e = gpu::sphere_emission(draw(i, 0), draw(i, 2));
        if (e.direction.z <= 0.0f) continue;
        const dvec3 at =
            dvec3(e.normal) + dvec3(e.direction) * ((distance - double(e.normal.z)) / double(e.direction.z));
        if (at.x * at.x + at.y * at.y < disc * disc) hits += 1.0;
    }
    // A point of the disc, s off the axis, receives pi L d / (d^2 + s^2)^1.5; over the disc that is pi L 2 pi
    // (1 - d / sqrt(d^2 + disc^2)).
    const double share = 2.0 * kSppmPi * (1.0 - distance / std::sqrt(distance * distance + disc * disc));
    const double expected = kPhotons * kSppmPi * share / double(gpu::sphere_emission_etendue(1.0f));
    EXPECT_LT(std::abs(hits - expected), 4.0 * std::sqrt(expected)) << hits << ' ' << expected;
}

TEST(SphereEmission, etendue_is_pi_times_the_area) {
    const double area = 4.0 * kSppmPi * 7.5 * 7.5;
    EXPECT_NEAR(double(gpu::sphere_emission_etendue(7.5f)), kSppmPi * area, 1e-6 * kSppmPi * area);
}

TEST(SphereCone, height_keeps_all_bits_from_tiny_to_touching) {
    test::TestRandom random(3);
    for (int i = 0; i < 100000; ++i) {
        const auto distance = static_cast<float>(std::exp2(random.uniform(-10.0, 20.0)));
        const auto radius = static_cast<float>(double(distance) * std::exp2(-random.uniform(1e-5, 40.0)));
        const gpu::SphereCone cone = gpu::sphere_cone(vec3(0.0f, distance, 0.0f), radius);
        if (!(distance > radius)) continue;
        const long double sine = static_cast<long double>(radius) / distance;
        const long double want = sine * sine / (1.0L + std::sqrt((1.0L - sine) * (1.0L + sine)));
        ASSERT_NEAR(static_cast<double>(cone.height / want), 1.0, 5e-7) << radius << ' ' << distance;
        ASSERT_TRUE(std::isfinite(gpu::sphere_cone_pdf(cone)));
    }
}

TEST(SphereCone, plain_difference_is_caught_for_a_tiny_light) {
    const float sine = 0.5f / 2000.0f;
    const float plain = 1.0f - std::sqrt(1.0f - sine * sine);
    const gpu::SphereCone cone = gpu::sphere_cone(vec3(2000.0f, 0.0f, 0.0f), 0.5f);
    EXPECT_GT(std::abs(plain / cone.height - 1.0f), 0.5f);
}

TEST(SphereCone, inside_and_hostile_numbers_give_no_cone) {
    EXPECT_EQ(gpu::sphere_cone(vec3(0.5f, 0.0f, 0.0f), 1.0f).height, 0.0f);
    EXPECT_EQ(gpu::sphere_cone(vec3(0.0f), 1.0f).height, 0.0f);
    EXPECT_EQ(gpu::sphere_cone(vec3(1.0f, 0.0f, 0.0f), 1.0f).height, 0.0f);
    EXPECT_EQ(gpu::sphere_cone(vec3(std::nanf("")), 1.0f).height, 0.0f);
}

// Irradiance of a surface that faces a ball is pi L (r / d)^2, whatever the distance; `pdf_scale` 1.02 is the
// negative control.
double irradiance_error(double pdf_scale) {
    constexpr std::uint32_t kDraws = 100000;
    double worst = 0.0;
    for (const float distance : {1.01f, 2.0f, 50.0f, 5000.0f}) {
        const gpu::SphereCone cone = gpu::sphere_cone(vec3(0.0f, 0.0f, distance), 1.0f);
        double sum = 0.0, squares = 0.0;
        for (std::uint32_t i = 0; i < kDraws; ++i) {
            const vec3 direction = gpu::uniform_cone(cone.axis, cone.height, draw(i, 0));
            const double value = double(direction.z) / (double(gpu::sphere_cone_pdf(cone)) * pdf_scale);
            sum += value;
            squares += value * value;
        }
        const double mean = sum / kDraws;
        const double want = kSppmPi / (double(distance) * double(distance));
        const double deviation = std::sqrt(std::max(0.0, squares / kDraws - mean * mean) / kDraws);
        worst = std::max(worst, std::abs(mean - want) / (deviation + 1e-6 * want));
    }
    return worst;
}

TEST(SphereCone, sampled_irradiance_is_the_closed_form) {
    EXPECT_LT(irradiance_error(1.0), 4.0);
}

TEST(SphereCone, pdf_off_by_a_fiftieth_is_caught) {
    EXPECT_GT(irradiance_error(1.02), 4.0);
}

}  // namespace
}  // namespace voxilux
