// Rough metal and rough glass against equations in double, quadrature, and themselves: light that is kept,
// light that goes backwards, and smooth limits.

#include "shared/bsdf.h"

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "passes/specular/rough_gains.h"
#include "support/dielectric_cases.h"
#include "support/statistics.h"

namespace voxilux {
namespace {

using glm::dvec3;
using glm::vec3;
using gpu::RoughValue;

constexpr double kRoughPi = std::numbers::pi;
const vec3 kUp(0.0f, 0.0f, 1.0f);

struct Lobe {
    float alpha;
    float eta;  // 0: metal
};

std::string name_of(const Lobe& lobe) {
    return "alpha " + std::to_string(lobe.alpha) + " eta " + std::to_string(lobe.eta);
}

vec3 leaning(float cosine) {
    return {std::sqrt(1.0f - cosine * cosine), 0.0f, cosine};
}

float gain_at(const std::vector<float>& row, float cosine, float alpha) {
    const float place = gpu::gain_place(cosine, alpha) * static_cast<float>(gpu::kGainPlaces - 1);
    const auto low = std::min(static_cast<std::size_t>(place), std::size_t{gpu::kGainPlaces - 2});
    return std::lerp(row[low], row[low + 1], place - static_cast<float>(low));
}

vec3 draw_direction(const Lobe& lobe, vec3 outward, test::TestRandom& random) {
    const auto u = [&] { return static_cast<float>(random.bits32() >> 8) * 0x1p-24f; };
    const float first = u(), second = u();
    return gpu::sample_rough(outward, kUp, lobe.alpha, lobe.eta, {first, second, u()});
}

// What a white surface sends of the light from `outward`, by sampling; without gains if there is no row.
double kept_light(const Lobe& lobe, float cosine, const std::vector<float>& row, int samples) {
    test::TestRandom random(7);
    const vec3 outward = leaning(cosine);
    double sum = 0.0;
    for (int i = 0; i < samples; ++i) {
        const vec3 inward = draw_direction(lobe, outward, random);
        const RoughValue value = gpu::evaluate_rough(outward, inward, kUp, lobe.alpha, lobe.eta);
        if (!(value.pdf > 0.0f)) continue;
        double gain = 1.0;
        if (!row.empty()) gain = double{gain_at(row, cosine, lobe.alpha)};
        if (!row.empty() && lobe.eta == 0.0f) gain *= double{gain_at(row, inward.z, lobe.alpha)};
        sum += double{value.weight} * gain;
    }
    return sum / samples;
}

constexpr std::array<float, 6> kAlphas = {1e-4f, 0.01f, 0.09f, 0.25f, 0.5f, 1.0f};
constexpr std::array<float, 5> kEtas = {0.0f, 1.5f, 1.0f / 1.5f, 2.5f, 0.4f};
constexpr int kFurnaceSamples = 20000;
// Of the gains, limits.h, and three standard deviations of the mean of weights that are mostly below 1.6.
constexpr double kFurnaceError = 0.01 + 3.0 * 0.5 / 141.0;

TEST(RoughBsdf, white_surface_keeps_all_light_at_every_angle) {
    for (const float eta : kEtas) {
        for (const float alpha : kAlphas) {
            const std::vector<float> row = rough_gains(alpha, eta);
            ASSERT_EQ(row.size(), gpu::kGainPlaces);
            for (const float cosine : {0.02f, 0.1f, 0.3f, 0.7f, 1.0f})
                EXPECT_NEAR(kept_light({alpha, eta}, cosine, row, kFurnaceSamples), 1.0, kFurnaceError)
                    << name_of({alpha, eta}) << " cosine " << cosine;
        }
    }
}

// Light that is caught in a block of glass meets thousands of surfaces: 1.001 to that power is large.
TEST(RoughBsdf, nearly_smooth_surface_that_faces_the_light_gains_nothing) {
    for (const float eta : kEtas)
        EXPECT_NEAR(rough_gains(4e-4f, eta).back(), 1.0f, 1e-6f) << eta;
}

TEST(RoughBsdf, without_gains_the_furnace_is_dark) {
    EXPECT_LT(kept_light({1.0f, 0.0f}, 0.3f, {}, kFurnaceSamples), 0.6);
    EXPECT_LT(kept_light({1.0f, 0.4f}, 0.3f, {}, kFurnaceSamples), 0.6);
    EXPECT_LT(kept_light({0.25f, 0.0f}, 0.1f, {}, kFurnaceSamples), 1.0 - 2.0 * kFurnaceError);
}

// The mean over directions is exact, to the error of quadrature; sampling would hide a percent.
TEST(RoughBsdf, white_metal_keeps_all_light_within_half_a_percent) {
    for (const float alpha : {0.04f, 0.2f, 0.6f, 1.0f}) {
        const std::vector<float> row = rough_gains(alpha, 0.0f);
        for (const float cosine : {0.05f, 0.4f, 0.95f}) {
            constexpr int kPoints = 46368, kStep = 28657;  // of a Fibonacci lattice
            double sum = 0.0;
            for (int i = 0; i < kPoints; ++i) {
                const glm::vec2 u(float(i) / kPoints, float(std::int64_t{i} * kStep % kPoints) / kPoints);
                const vec3 inward = gpu::mirror_direction(-leaning(cosine),
                                                          gpu::sample_facet(leaning(cosine), kUp, alpha, u));
                if (inward.z <= 0.0f) continue;
                sum += double{gpu::unmasked(cosine, inward.z, alpha)} *
                       double{gain_at(row, cosine, alpha) * gain_at(row, inward.z, alpha)};
            }
            EXPECT_NEAR(sum / kPoints, 1.0, 0.005) << alpha << ' ' << cosine;
        }
    }
}

TEST(RoughBsdf, coloured_metal_keeps_less_the_more_often_it_scatters) {
    const vec3 factor = gpu::metal_factor({0.5f, 1.0f, 0.0f}, 1.5f);
    EXPECT_EQ(factor, vec3(1.25f, 1.5f, 1.0f));
}

// The equations of Walter et al. 2007 (20, 21, 33, 34) in double, with height-correlated masking. Value times
// cosine of the inward direction; refraction without its factor on radiance.
double walter(const Lobe& lobe, dvec3 o, dvec3 i) {
    const double a2 = double{lobe.alpha} * double{lobe.alpha}, eta = double{lobe.eta};
    const bool crosses = i.z < 0.0;
    dvec3 h = crosses ? -(o + eta * i) : o + i;
    h = glm::normalize(h);
    if (h.z < 0.0) h = -h;
    const double oh = glm::dot(o, h), ih = glm::dot(i, h);
    if (oh <= 0.0 || (ih < 0.0) != crosses) return 0.0;
    const double tan2 = (1.0 - h.z * h.z) / (h.z * h.z);
    const double density = a2 / (kRoughPi * std::pow(h.z, 4.0) * std::pow(a2 + tan2, 2.0));
    const auto lambda = [&](double c) { return 0.5 * (std::sqrt(1.0 + a2 * (1.0 - c * c) / (c * c)) - 1.0); };
    const double masking = 1.0 / (1.0 + lambda(o.z) + lambda(i.z));
    double reflected = 1.0;
    if (eta != 0.0) {
        const double g2 = eta * eta - 1.0 + oh * oh;
        const double g = std::sqrt(std::max(g2, 0.0));
        if (g2 > 0.0)
            reflected = 0.5 * std::pow((g - oh) / (g + oh), 2.0) *
                        (1.0 + std::pow((oh * (g + oh) - 1.0) / (oh * (g - oh) + 1.0), 2.0));
    }
    if (!crosses) return reflected * density * masking / (4.0 * o.z);
    const double sum = oh + eta * ih;
    return std::abs(oh * ih / o.z) * eta * eta * (1.0 - reflected) * masking * density / (sum * sum);
}

dvec3 random_double_unit(test::TestRandom& random) {
    return dvec3(test::random_float_unit(random));
}

TEST(RoughBsdf, value_is_that_of_walter_in_double) {
    test::TestRandom random(17);
    int compared = 0;
    for (int n = 0; n < 200000; ++n) {
        const Lobe lobe{static_cast<float>(std::exp2(random.uniform(-4.0, 0.0))), kEtas[random.bits32() % 5]};
        dvec3 o = random_double_unit(random);
        o.z = std::abs(o.z);
        const dvec3 i = random_double_unit(random);
        if (o.z < 0.01 || std::abs(i.z) < 0.01) continue;
        const RoughValue value = gpu::evaluate_rough(vec3(o), vec3(i), kUp, lobe.alpha, lobe.eta);
        const double expected = i.z < 0.0 && lobe.eta == 0.0f ? 0.0 : walter(lobe, o, i);
        const double got = double{value.pdf} * double{value.weight};
        // Where the half vector is nearly along the surface, floats and doubles may differ in what is hidden.
        ASSERT_NEAR(got, expected, 2e-3 * expected + 1e-5) << name_of(lobe) << ' ' << n;
        compared += expected > 0.01 ? 1 : 0;
    }
    EXPECT_GT(compared, 20000);
}

TEST(RoughBsdf, light_goes_backwards_as_it_came) {
    test::TestRandom random(18);
    int compared = 0;
    for (int n = 0; n < 100000; ++n) {
        const Lobe lobe{static_cast<float>(std::exp2(random.uniform(-4.0, 0.0))), kEtas[random.bits32() % 5]};
        vec3 o(random_double_unit(random));
        o.z = std::max(std::abs(o.z), 0.01f);
        o = glm::normalize(o);
        const vec3 i(random_double_unit(random));
        if (std::abs(i.z) < 0.01f) continue;
        const RoughValue there = gpu::evaluate_rough(o, i, kUp, lobe.alpha, lobe.eta);
        const float side = i.z < 0.0f ? -1.0f : 1.0f;
        const float back_eta = there.crosses && lobe.eta != 0.0f ? 1.0f / lobe.eta : lobe.eta;
        const RoughValue back = gpu::evaluate_rough(i, o, side * kUp, lobe.alpha, back_eta);
        const double square = there.crosses ? double{lobe.eta} * double{lobe.eta} : 1.0;
        const double a =
            double{there.pdf * there.weight} / (std::abs(double{i.z}) * (square > 0 ? square : 1));
        const double b = double{back.pdf * back.weight} / double{o.z};
        ASSERT_NEAR(a, b, 2e-3 * std::max(a, b) + 1e-4) << name_of(lobe) << ' ' << n;
        compared += a > 0.01 ? 1 : 0;
    }
    EXPECT_GT(compared, 10000);
}

// Bins of equal solid angle over the whole sphere, 24 x 16.
constexpr int kBands = 24, kSectors = 16;

std::size_t bin_of(vec3 direction) {
    const auto band = static_cast<int>((double{direction.z} + 1.0) * 0.5 * kBands);
    const double turn = std::atan2(double{direction.y}, double{direction.x}) / (2.0 * kRoughPi) + 0.5;
    return static_cast<std::size_t>(std::min(band, kBands - 1) * kSectors +
                                    std::min(static_cast<int>(turn * kSectors), kSectors - 1));
}

// The integral of the pdf over each bin, and of pdf * weight over all.
std::vector<double> mass_of_bins(const Lobe& lobe, vec3 outward, double& sent) {
    constexpr int kFine = 24;
    std::vector<double> mass(kBands * kSectors);
    const double cell = 4.0 * kRoughPi / (kBands * kSectors * kFine * kFine);
    sent = 0.0;
    for (int b = 0; b < kBands * kFine; ++b) {
        for (int s = 0; s < kSectors * kFine; ++s) {
            const double z = (b + 0.5) / (0.5 * kBands * kFine) - 1.0;
            const double turn = 2.0 * kRoughPi * ((s + 0.5) / (kSectors * kFine) - 0.5);
            const double r = std::sqrt(1.0 - z * z);
            const vec3 direction(dvec3(r * std::cos(turn), r * std::sin(turn), z));
            const RoughValue value = gpu::evaluate_rough(outward, direction, kUp, lobe.alpha, lobe.eta);
            mass[static_cast<std::size_t>((b / kFine) * kSectors + s / kFine)] += double{value.pdf} * cell;
            sent += double{value.pdf} * double{value.weight} * cell;
        }
    }
    return mass;
}

struct ChiSquare {
    double statistic;
    double critical;
};

// Samples of `drawn` against the pdf of `claimed`.
ChiSquare chi_square_of(const Lobe& drawn, const Lobe& claimed, vec3 outward, int samples) {
    test::TestRandom random(19);
    std::vector<std::uint64_t> seen(kBands * kSectors + 1);
    for (int i = 0; i < samples; ++i) {
        const vec3 inward = draw_direction(drawn, outward, random);
        const bool is_sound = gpu::evaluate_rough(outward, inward, kUp, drawn.alpha, drawn.eta).pdf > 0.0f;
        ++seen[is_sound ? bin_of(inward) : seen.size() - 1];
    }
    double sent = 0.0, total = 0.0;
    std::vector<double> expected = mass_of_bins(claimed, outward, sent);
    for (const double mass : expected)
        total += mass;
    expected.push_back(1.0 - total);  // no direction
    std::vector<std::uint64_t> seen_bins(1);
    std::vector<double> expected_bins(1);
    for (std::size_t i = 0; i < seen.size(); ++i) {
        const bool is_full = expected[i] * samples >= 20.0;  // the others are one bin
        const std::size_t to = is_full ? seen_bins.size() : 0;
        if (is_full) {
            seen_bins.push_back(0);
            expected_bins.push_back(0.0);
        }
        seen_bins[to] += seen[i];
        expected_bins[to] += std::max(expected[i], 0.0) * samples;
    }
    expected_bins[0] = std::max(expected_bins[0], 1.0);
    return {test::chi_square(seen_bins, expected_bins), test::chi_square_critical_99(seen_bins.size() - 1)};
}

constexpr std::array<Lobe, 6> kLobes = {
    {{0.3f, 0.0f}, {0.8f, 0.0f}, {0.3f, 1.5f}, {0.8f, 1.5f}, {0.4f, 0.5f}, {0.9f, 0.6f}}};

TEST(RoughBsdf, samples_follow_the_pdf) {
    for (const Lobe& lobe : kLobes) {
        for (const float cosine : {0.15f, 0.6f, 0.98f}) {
            const ChiSquare chi = chi_square_of(lobe, lobe, leaning(cosine), 100000);
            EXPECT_LT(chi.statistic, chi.critical) << name_of(lobe) << " cosine " << cosine;
        }
    }
}

TEST(RoughBsdf, pdf_of_three_percent_more_roughness_is_caught) {
    const ChiSquare chi = chi_square_of({0.3f, 0.0f}, {0.309f, 0.0f}, leaning(0.6f), 100000);
    EXPECT_GT(chi.statistic, chi.critical);
}

// The part of samples that has a direction, and what these send, against integrals over all directions.
TEST(RoughBsdf, mean_of_samples_is_the_integral_and_a_pdf_off_by_a_percent_is_caught) {
    constexpr int kCount = 200000;
    for (const Lobe& lobe : kLobes) {
        const vec3 outward = leaning(0.5f);
        double sent = 0.0, total = 0.0;
        for (const double mass : mass_of_bins(lobe, outward, sent))
            total += mass;
        test::TestRandom random(20);
        double sound = 0.0, weight = 0.0;
        for (int i = 0; i < kCount; ++i) {
            const vec3 inward = draw_direction(lobe, outward, random);
            const RoughValue value = gpu::evaluate_rough(outward, inward, kUp, lobe.alpha, lobe.eta);
            sound += value.pdf > 0.0f ? 1.0 / kCount : 0.0;
            weight += value.pdf > 0.0f ? double{value.weight} / kCount : 0.0;
        }
        constexpr double kError = 4.0 * 0.5 / 447.0;  // four standard deviations of at most 0.5
        EXPECT_NEAR(sound, total, kError) << name_of(lobe);
        EXPECT_NEAR(weight, sent, kError) << name_of(lobe);
        EXPECT_GT(std::abs(sound - 1.01 * total), kError) << name_of(lobe);
    }
}

TEST(RoughBsdf, roughness_below_the_least_is_smooth) {
    for (const float roughness : {0.0f, 1e-4f, 0.00999f})
        EXPECT_EQ(gpu::rough_alpha(roughness), 0.0f);
    EXPECT_EQ(gpu::rough_alpha(0.01f), 0.01f * 0.01f);
    EXPECT_EQ(gpu::rough_alpha(1.0f), 1.0f);
    EXPECT_FALSE(gpu::is_rough(0.0f, 0.0f));
    EXPECT_TRUE(gpu::is_rough(1e-4f, 0.0f));
    EXPECT_TRUE(gpu::is_rough(1e-4f, 1.5f));
    EXPECT_FALSE(gpu::is_rough(1.0f, 1.0f)) << "glass that bends no light is clear";
}

// At the least roughness, samples lie around the directions of the smooth surface, as often in each, and
// carry what that sends.
TEST(RoughBsdf, least_roughness_is_nearly_the_smooth_surface) {
    const float alpha = gpu::rough_alpha(gpu::kMinRoughness);
    test::TestRandom random(21);
    for (const float eta : kEtas) {
        const vec3 outward = leaning(0.7f);
        const gpu::Dielectric surface = gpu::dielectric(0.7f, eta == 0.0f ? 1.5f : eta);
        double away = 0.0, reflected = 0.0, weight = 0.0;
        constexpr int kCount = 100000;
        for (int i = 0; i < kCount; ++i) {
            const vec3 inward = draw_direction({alpha, eta}, outward, random);
            const RoughValue value = gpu::evaluate_rough(outward, inward, kUp, alpha, eta);
            ASSERT_GT(value.pdf, 0.0f);
            const vec3 smooth = value.crosses ? gpu::refracted_direction(-outward, kUp, eta, surface)
                                              : gpu::mirror_direction(-outward, kUp);
            away += double{glm::distance(inward, smooth)} / kCount;
            reflected += value.crosses ? 0.0 : 1.0 / kCount;
            weight += double{value.weight} / kCount;
        }
        EXPECT_LT(away, 10.0 * double{alpha}) << eta;
        EXPECT_NEAR(reflected, eta == 0.0f ? 1.0 : double{surface.reflectance}, 4.0 * 0.5 / 316.0) << eta;
        EXPECT_NEAR(weight, 1.0, 1e-4) << eta;
    }
}

TEST(RoughBsdf, hostile_numbers_give_unit_directions_or_none_and_no_nan) {
    constexpr float kLast = 1.0f - 0x1p-24f;
    for (const float alpha : {1e-4f, 0.01f, 1.0f})
        for (const float eta : {0.0f, 1.1f, 4.0f, 0.25f, 1.0f / 1.1f})
            for (const float cosine : {1e-7f, 1e-4f, 0.5f, 1.0f})
                for (const float x : {0.0f, 0.5f, kLast})
                    for (const float y : {0.0f, 0.5f, kLast})
                        for (const float z : {0.0f, kLast}) {
                            const vec3 outward = leaning(cosine);
                            const vec3 inward = gpu::sample_rough(outward, kUp, alpha, eta, {x, y, z});
                            const float length = glm::length(inward);
                            ASSERT_TRUE(length == 0.0f || std::abs(length - 1.0f) < 1e-5f);
                            const RoughValue value = gpu::evaluate_rough(outward, inward, kUp, alpha, eta);
                            ASSERT_TRUE(value.pdf >= 0.0f && std::isfinite(value.pdf));
                            ASSERT_TRUE(value.weight >= 0.0f && value.weight < 3.0f);
                        }
}

}  // namespace
}  // namespace voxilux
