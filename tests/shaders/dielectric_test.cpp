#include "shared/dielectric.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "support/dielectric_cases.h"

namespace voxilux {
namespace {

using glm::dvec3;
using glm::vec3;
using gpu::Dielectric;
using test::DielectricCase;

// Absolute, of a reflectance up to 1.
constexpr double kTwoUlp = 2.0 * 0x1p-23;
constexpr double kUnit = 4.0 * 0x1p-24;  // direction components: a few roundings

TEST(Dielectric, reflectance_and_exact_transmittance_sum_to_1_within_2_ulp) {
    for (const DielectricCase& c : test::dielectric_cases(200000)) {
        const Dielectric surface = gpu::dielectric(c.cosine, c.eta);
        ASSERT_GE(surface.reflectance, 0.0f);
        ASSERT_LE(surface.reflectance, 1.0f);
        const long double transmitted = test::exact_transmittance(c.cosine, c.eta);
        ASSERT_NEAR(static_cast<double>(surface.reflectance + transmitted), 1.0, kTwoUlp)
            << c.cosine << ' ' << c.eta;
        ASSERT_EQ(surface.is_total, transmitted <= 0.0L) << c.cosine << ' ' << c.eta;
    }
}

// The same in plain floats: near the critical angle the root loses half its bits.
float plain_reflectance(float c, float eta) {
    const float sine2 = (1.0f - c * c) / (eta * eta);
    if (sine2 >= 1.0f) return 1.0f;
    const float cos_to = std::sqrt(1.0f - sine2);
    const float across = (c - eta * cos_to) / (c + eta * cos_to);
    const float within = (eta * c - cos_to) / (eta * c + cos_to);
    return 0.5f * (across * across + within * within);
}

TEST(Dielectric, plain_floats_are_caught) {
    int wrong = 0;
    for (const DielectricCase& c : test::dielectric_cases(20000)) {
        const auto sum = static_cast<double>(plain_reflectance(c.cosine, c.eta) +
                                             test::exact_transmittance(c.cosine, c.eta));
        wrong += std::abs(sum - 1.0) > kTwoUlp ? 1 : 0;
    }
    EXPECT_GT(wrong, 500);
}

TEST(Dielectric, known_values) {
    EXPECT_NEAR(gpu::dielectric(1.0f, 1.5f).reflectance, 0.04f, 1e-8f);  // ((n - 1) / (n + 1))^2
    EXPECT_NEAR(gpu::dielectric(1.0f, 1.0f / 1.5f).reflectance, 0.04f, 2e-8f);
    EXPECT_EQ(gpu::dielectric(0.0f, 1.5f).reflectance, 1.0f);
    EXPECT_GT(gpu::dielectric(1e-6f, 1.5f).reflectance, 0.99999f);
    EXPECT_FALSE(gpu::dielectric(1e-6f, 1.5f).is_total);
    EXPECT_EQ(gpu::radiance_scale(2.0f), 0.25f);
}

// At tan(angle) = eta no light polarised in the plane is reflected.
TEST(Dielectric, brewster_angle_reflects_only_what_is_polarised_across) {
    for (const double eta : {1.1, 1.333, 1.5, 2.4, 1.0 / 1.5}) {
        const double across = (1.0 - eta * eta) / (1.0 + eta * eta);
        const auto cosine = static_cast<float>(1.0 / std::sqrt(1.0 + eta * eta));
        EXPECT_NEAR(gpu::dielectric(cosine, static_cast<float>(eta)).reflectance, 0.5 * across * across,
                    2e-7);
    }
}

TEST(Dielectric, reflectance_is_the_same_from_both_sides) {
    test::TestRandom random(5);
    for (int i = 0; i < 100000; ++i) {
        const auto eta = static_cast<float>(random.uniform(1.0, 4.0));
        const auto near_cosine = static_cast<float>(random.uniform(0.1, 1.0));
        const double sine2 = (1.0 - double(near_cosine) * double(near_cosine)) / (double(eta) * double(eta));
        const auto far_cosine = static_cast<float>(std::sqrt(1.0 - sine2));
        ASSERT_NEAR(gpu::dielectric(near_cosine, eta).reflectance,
                    gpu::dielectric(far_cosine, 1.0f / eta).reflectance, 2e-5)
            << near_cosine << ' ' << eta;
    }
}

TEST(Dielectric, total_reflection_starts_exactly_at_the_critical_angle) {
    // cos = sqrt(1 - eta^2) is a float for these.
    for (const auto& [eta, critical] : {std::pair(0.6f, 0.8f), std::pair(0.8f, 0.6f)}) {
        for (const float cosine :
             {std::nextafter(critical, 0.0f), critical, std::nextafter(critical, 1.0f)}) {
            const Dielectric surface = gpu::dielectric(cosine, eta);
            const long double g2 =
                static_cast<long double>(eta) * eta - 1.0L + static_cast<long double>(cosine) * cosine;
            EXPECT_EQ(surface.is_total, g2 <= 0.0L) << cosine;
            EXPECT_LE(surface.reflectance, 1.0f);
            EXPECT_GT(surface.reflectance, 0.99f);
            EXPECT_EQ(surface.reflectance + (1.0f - surface.reflectance), 1.0f);
        }
    }
}

// What Snell's law leaves: n sin is the same on both sides, in one plane with the normal.
double snell_error(const DielectricCase& c, vec3 refracted) {
    const dvec3 before = glm::cross(dvec3(c.direction), dvec3(c.normal));
    const dvec3 after = glm::cross(dvec3(refracted), dvec3(c.normal)) * static_cast<double>(c.eta);
    return glm::length(before - after);
}

TEST(Dielectric, refracted_directions_obey_snell_and_are_unit) {
    for (const DielectricCase& c : test::dielectric_cases(100000)) {
        const float cosine = -glm::dot(c.direction, c.normal);
        const Dielectric surface = gpu::dielectric(cosine, c.eta);
        if (surface.is_total) continue;
        const vec3 refracted = gpu::refracted_direction(c.direction, c.normal, c.eta, surface);
        ASSERT_NEAR(glm::length(dvec3(refracted)), 1.0, kUnit);
        ASSERT_LT(snell_error(c, refracted), 4.0 * kUnit * std::max(1.0, double(c.eta))) << c.eta;
        ASSERT_LE(glm::dot(refracted, c.normal), 4.0f * 0x1p-24f);
        const vec3 mirrored = gpu::mirror_direction(c.direction, c.normal);
        ASSERT_NEAR(glm::length(dvec3(mirrored)), 1.0, kUnit);
        ASSERT_NEAR(glm::dot(mirrored, c.normal), cosine, 4.0 * kUnit);
    }
}

// sin t = (eta sin i)^2, with eta = n_near / n_far: negative control.
vec3 squared_sine_direction(const DielectricCase& c) {
    const dvec3 n(c.normal);
    const dvec3 along = dvec3(c.direction) - glm::dot(dvec3(c.direction), n) * n;
    const double sine = std::min(1.0, glm::dot(along, along) / (double(c.eta) * double(c.eta)));
    return vec3(sine * glm::normalize(along) - std::sqrt(1.0 - sine * sine) * n);
}

TEST(Dielectric, squared_sine_in_place_of_snell_is_caught) {
    int wrong = 0, total = 0;
    for (const DielectricCase& c : test::dielectric_cases(10000)) {
        const float cosine = -glm::dot(c.direction, c.normal);
        if (c.eta == 1.0f || cosine > 0.999f || gpu::dielectric(cosine, c.eta).is_total) continue;
        ++total;
        wrong +=
            snell_error(c, squared_sine_direction(c)) > 4.0 * kUnit * std::max(1.0, double(c.eta)) ? 1 : 0;
    }
    EXPECT_GT(wrong, total * 99 / 100);
}

// A slab of thickness t moves a beam sideways by t sin(i) (1 - cos(i) / sqrt(eta^2 - sin(i)^2)).
TEST(Dielectric, slab_moves_a_beam_by_the_closed_form) {
    const vec3 up(0, 0, 1);
    for (const float eta : {1.0f, 1.1f, 1.5f, 2.5f}) {
        for (const double angle : {0.0, 0.3, 0.8, 1.4}) {
            const vec3 in(static_cast<float>(std::sin(angle)), 0, static_cast<float>(-std::cos(angle)));
            const vec3 inside =
                gpu::refracted_direction(in, up, eta, gpu::dielectric(-glm::dot(in, up), eta));
            const float back = 1.0f / eta;
            const vec3 out =
                gpu::refracted_direction(inside, up, back, gpu::dielectric(-glm::dot(inside, up), back));
            EXPECT_LT(glm::length(dvec3(out) - dvec3(in)), 1e-6) << eta << ' ' << angle;
            const dvec3 leaves = dvec3(inside) / -double(inside.z);  // a slab of thickness 1
            const double shift = glm::length(glm::cross(leaves, dvec3(in)));
            const double sine = std::sin(angle);
            const double n2 = double(eta) * double(eta);
            EXPECT_NEAR(shift, sine * (1.0 - std::cos(angle) / std::sqrt(n2 - sine * sine)), 1e-6);
        }
    }
}

// A ball of radius R brings a thin beam together n R / (2 (n - 1)) behind its centre.
TEST(Dielectric, ball_focuses_at_the_closed_form) {
    for (const float eta : {1.333f, 1.5f, 1.8f}) {
        const vec3 in(1, 0, 0);
        const float height = 0.01f;  // of the beam over the axis, of a ball of radius 1
        const vec3 entry(-std::sqrt(1.0f - height * height), height, 0);
        const vec3 inside = gpu::refracted_direction(in, entry, eta, gpu::dielectric(-entry.x, eta));
        const float chord = -2.0f * glm::dot(entry, inside);
        const vec3 exit = entry + chord * inside;
        const float back = 1.0f / eta;
        const vec3 out =
            gpu::refracted_direction(inside, -exit, back, gpu::dielectric(glm::dot(inside, exit), back));
        const double focus = double(exit.x) - double(exit.y) * double(out.x) / double(out.y);
        const double n = eta;
        EXPECT_NEAR(focus, n / (2.0 * (n - 1.0)), 1e-3) << eta;
    }
}

TEST(Dielectric, eta_1_lets_everything_through_to_the_bit) {
    for (const DielectricCase& c : test::dielectric_cases(1000)) {
        const Dielectric surface = gpu::dielectric(c.cosine, 1.0f);
        EXPECT_EQ(surface.reflectance, 0.0f);
        EXPECT_FALSE(surface.is_total);
        EXPECT_EQ(gpu::refracted_direction(c.direction, c.normal, 1.0f, surface), c.direction);
    }
    EXPECT_EQ(gpu::dielectric(0.0f, 1.0f).reflectance, 0.0f);
    EXPECT_EQ(gpu::radiance_scale(1.0f), 1.0f);
}

TEST(Dielectric, hostile_numbers_never_give_nan) {
    for (const float cosine : test::hostile_floats()) {
        for (const float eta : test::hostile_floats()) {
            const Dielectric surface = gpu::dielectric(cosine, eta);
            ASSERT_GE(surface.reflectance, 0.0f) << cosine << ' ' << eta;
            ASSERT_LE(surface.reflectance, 1.0f) << cosine << ' ' << eta;
            ASSERT_FALSE(std::isnan(surface.bend)) << cosine << ' ' << eta;
        }
    }
}

}  // namespace
}  // namespace voxilux
