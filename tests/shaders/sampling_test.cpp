#include "shared/sampling.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "shared/sequence.h"
#include "support/integrands.h"
#include "support/statistics.h"

namespace voxilux {
namespace {

using glm::dvec3;
using glm::vec2;
using glm::vec3;

constexpr double kPi = std::numbers::pi;
constexpr std::uint32_t kSamples = 1000000;
constexpr std::size_t kHeightBins = 20;
constexpr std::size_t kAngleBins = 24;

vec2 white_point(std::uint32_t i) {
    return {gpu::rng_float(1, 2, i, 0), gpu::rng_float(1, 2, i, 1)};
}

// Corners of the unit square, its centre lines and its diagonals: where maps of the square break.
std::vector<vec2> awkward_points() {
    const float last = 1.0f - 0x1p-24f;
    const std::vector<float> values = {0.0f, 0x1p-24f,        0.25f, 0.5f - 0x1p-24f,
                                       0.5f, 0.5f + 0x1p-23f, 0.75f, last};
    std::vector<vec2> points;
    for (const float x : values)
        for (const float y : values)
            points.emplace_back(x, y);
    return points;
}

// Unit vectors that break naive bases: axes with both signs of zero, near the poles, and random ones.
std::vector<vec3> awkward_normals() {
    std::vector<vec3> normals = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0},         {0, -1, 0},
                                 {0, 0, 1}, {0, 0, -1}, {-0.0f, 1, -0.0f}, {1, -0.0f, -0.0f}};
    for (const float e : {1e-3f, 1e-5f, 1e-10f, 1e-20f})
        for (const float z : {1.0f, -1.0f})
            normals.push_back(glm::normalize(vec3(e, -e, z)));
    test::TestRandom random(6);
    while (normals.size() < 500) {
        const dvec3 v(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
        if (glm::length(v) > 0.1) normals.emplace_back(glm::normalize(v));
    }
    return normals;
}

// Chi-square of `height(i)` in [0, 1) and azimuth in [0, 2 pi), both expected uniform and independent.
template <typename Draw>
double cap_chi_square(Draw draw) {
    std::vector<std::uint64_t> seen(kHeightBins * kAngleBins, 0);
    for (std::uint32_t i = 0; i < kSamples; ++i) {
        const auto [height, azimuth] = draw(i);
        const auto row = std::min(kHeightBins - 1, static_cast<std::size_t>(height * kHeightBins));
        const double turn = azimuth / (2.0 * kPi);
        const auto column =
            std::min(kAngleBins - 1, static_cast<std::size_t>((turn - std::floor(turn)) * kAngleBins));
        ++seen[row * kAngleBins + column];
    }
    const std::vector<double> expected(seen.size(), kSamples / static_cast<double>(seen.size()));
    return test::chi_square(seen, expected);
}

const double kCapCritical = test::chi_square_critical_99(kHeightBins * kAngleBins - 1);

struct CapPoint {
    double height;
    double azimuth;
};

// Height and azimuth of a direction in the frame (x, y, z) of doubles.
CapPoint cap_point(dvec3 v, dvec3 x, dvec3 y, double height) {
    return {height, std::atan2(glm::dot(v, y), glm::dot(v, x))};
}

TEST(Sampling, sin_cos_eighth_is_within_two_ulp_of_double) {
    double worst = 0.0;
    for (int i = -100000; i <= 100000; ++i) {
        const float s = static_cast<float>(i) * 1e-5f;
        const vec2 value = gpu::sin_cos_eighth(s);
        const double angle = 0.25 * kPi * static_cast<double>(s);
        worst =
            std::max(worst, std::abs(value.x - std::sin(angle)) / std::max(std::abs(std::sin(angle)), 1e-30));
        worst = std::max(worst, std::abs(value.y - std::cos(angle)) / std::cos(angle));
    }
    RecordProperty("worst", std::to_string(worst));
    EXPECT_LT(worst, 2.0 * 0x1p-23);
}

TEST(Sampling, disk_points_stay_strictly_between_centre_and_rim) {
    for (const vec2 u : awkward_points()) {
        const vec3 disk = gpu::concentric_disk(u);
        EXPECT_GT(disk.z, 0.0f);
        EXPECT_LT(disk.z, 1.0f);
        const double length = std::hypot(static_cast<double>(disk.x), static_cast<double>(disk.y));
        EXPECT_NEAR(length, disk.z, gpu::kUnitLengthError);
    }
}

TEST(Sampling, face_normals_are_the_six_axes) {
    const std::array<vec3, 6> normals = {vec3(-1, 0, 0), {1, 0, 0},  {0, -1, 0},
                                         {0, 1, 0},      {0, 0, -1}, {0, 0, 1}};
    for (std::uint32_t face = 0; face < 6; ++face)
        EXPECT_EQ(gpu::face_normal(face), normals[face]);
}

TEST(Sampling, cosine_directions_are_unit_and_leave_the_face) {
    std::vector<vec2> points = awkward_points();
    for (std::uint32_t i = 0; i < 50000; ++i)
        points.push_back(white_point(i));
    double worst = 0.0;
    for (std::uint32_t face = 0; face < 6; ++face) {
        for (const vec2 u : points) {
            const vec3 v = gpu::cosine_on_face(face, u);
            ASSERT_GE(glm::dot(v, gpu::face_normal(face)), 0x1p-12f);
            worst = std::max(worst, std::abs(glm::length(dvec3(v)) - 1.0));
        }
    }
    RecordProperty("worst", std::to_string(worst));
    EXPECT_LT(worst, gpu::kUnitLengthError);
}

TEST(Sampling, cosine_on_every_face_has_the_cosine_density) {
    for (std::uint32_t face = 0; face < 6; ++face) {
        const dvec3 n(gpu::face_normal(face));
        const dvec3 x(n.y != 0.0 || n.z != 0.0 ? 1.0 : 0.0, n.x != 0.0 ? 1.0 : 0.0, 0.0);
        const dvec3 y = glm::cross(n, x);
        const auto draw = [&](std::uint32_t i) {
            const dvec3 v(gpu::cosine_on_face(face, white_point(i)));
            const double z = glm::dot(v, n);
            return cap_point(v, x, y, z * z);
        };
        EXPECT_LT(cap_chi_square(draw), kCapCritical) << "face " << face;
    }
}

TEST(Sampling, cosine_about_a_normal_has_the_cosine_density) {
    const vec3 normal = glm::normalize(vec3(0.3f, -0.5f, -0.8f));
    const gpu::Basis basis = gpu::basis_around(normal);
    const auto draw = [&](std::uint32_t i) {
        const dvec3 v(gpu::cosine_about(normal, white_point(i)));
        const double z = glm::dot(v, dvec3(normal));
        return cap_point(v, dvec3(basis.tangent), dvec3(basis.bitangent), z * z);
    };
    EXPECT_LT(cap_chi_square(draw), kCapCritical);
}

TEST(Sampling, a_uniform_hemisphere_is_caught_as_not_cosine) {
    const auto draw = [](std::uint32_t i) {
        const vec2 u = white_point(i);
        return CapPoint{static_cast<double>(u.x) * u.x, 2.0 * kPi * u.y};
    };
    EXPECT_GT(cap_chi_square(draw), kCapCritical);
}

TEST(Sampling, a_cosine_raised_to_1_02_is_caught) {
    const auto draw = [](std::uint32_t i) {
        const vec3 v = gpu::cosine_hemisphere(white_point(i));
        const CapPoint p = cap_point(dvec3(v), {1, 0, 0}, {0, 1, 0}, std::pow(v.z, 2.04));
        return p;
    };
    EXPECT_GT(cap_chi_square(draw), kCapCritical);
}

TEST(Sampling, bases_are_orthonormal_and_right_handed) {
    for (const vec3 n : awkward_normals()) {
        const gpu::Basis b = gpu::basis_around(n);
        const dvec3 t(b.tangent);
        const dvec3 s(b.bitangent);
        EXPECT_NEAR(glm::length(t), 1.0, gpu::kUnitLengthError);
        EXPECT_NEAR(glm::length(s), 1.0, gpu::kUnitLengthError);
        EXPECT_NEAR(glm::dot(t, s), 0.0, gpu::kUnitLengthError);
        EXPECT_NEAR(glm::dot(t, dvec3(n)), 0.0, gpu::kUnitLengthError);
        EXPECT_NEAR(glm::length(glm::cross(t, s) - dvec3(n)), 0.0, gpu::kUnitLengthError);
    }
}

TEST(Sampling, directions_about_awkward_normals_are_unit_and_in_the_hemisphere) {
    for (const vec3 n : awkward_normals()) {
        for (const vec2 u : awkward_points()) {
            const dvec3 v(gpu::cosine_about(n, u));
            ASSERT_NEAR(glm::length(v), 1.0, gpu::kUnitLengthError);
            ASSERT_GT(glm::dot(v, dvec3(n)), 0x1p-13);
        }
    }
}

// A cone of `degrees` around `axis`: 1 - cos is uniform from 0 to the height, azimuth is uniform. 1 - cos
// comes from the sine, as in the sampler's contract.
double cone_chi_square(double degrees, vec3 axis, double wrong_height_factor) {
    const double height = 2.0 * std::pow(std::sin(degrees * kPi / 360.0), 2.0);
    const gpu::Basis basis = gpu::basis_around(axis);
    const auto draw = [&](std::uint32_t i) {
        const dvec3 v(
            gpu::uniform_cone(axis, static_cast<float>(height * wrong_height_factor), white_point(i)));
        const double along = glm::dot(v, dvec3(axis));
        const double sine = glm::length(v - along * dvec3(axis));
        const double gap = along > 0.0 ? sine * sine / (1.0 + along) : 1.0 - along;
        return cap_point(v, dvec3(basis.tangent), dvec3(basis.bitangent), gap / height);
    };
    return cap_chi_square(draw);
}

TEST(Sampling, cone_of_the_sun_is_uniform_in_solid_angle) {
    EXPECT_LT(cone_chi_square(0.265, glm::normalize(vec3(0.4f, 0.2f, 0.9f)), 1.0), kCapCritical);
}

TEST(Sampling, wide_cones_are_uniform_in_solid_angle) {
    EXPECT_LT(cone_chi_square(60.0, vec3(0, 0, -1), 1.0), kCapCritical);
    EXPECT_LT(cone_chi_square(170.0, glm::normalize(vec3(-1, 2, -3)), 1.0), kCapCritical);
}

TEST(Sampling, a_cone_one_percent_too_narrow_is_caught) {
    EXPECT_GT(cone_chi_square(0.265, glm::normalize(vec3(0.4f, 0.2f, 0.9f)), 0.99), kCapCritical);
}

TEST(Sampling, cone_of_angle_zero_is_exactly_the_direction) {
    EXPECT_EQ(gpu::cone_height(0.0f), 0.0f);
    for (const vec3 n : awkward_normals())
        for (const vec2 u : awkward_points())
            ASSERT_EQ(gpu::uniform_cone(n, 0.0f, u), n);
}

TEST(Sampling, cone_height_keeps_its_bits_at_small_angles) {
    for (const double degrees : {1e-6, 1e-3, 0.265, 1.0, 45.0, 90.0, 180.0}) {
        const float angle = static_cast<float>(degrees * kPi / 180.0);
        const double expected = 2.0 * std::pow(std::sin(0.5 * static_cast<double>(angle)), 2.0);
        EXPECT_NEAR(gpu::cone_height(angle) / expected, 1.0, 4.0 * 0x1p-23) << degrees;
    }
    EXPECT_NEAR(gpu::cone_solid_angle(gpu::cone_height(static_cast<float>(kPi))), 4.0 * kPi, 1e-5);
}

// The textbook map with a square root for the radius and an angle.
vec3 polar_hemisphere(vec2 u) {
    const double radius = std::sqrt(static_cast<double>(u.x));
    const double angle = 2.0 * kPi * static_cast<double>(u.y);
    return {radius * std::cos(angle), radius * std::sin(angle), std::sqrt(1.0 - radius * radius)};
}

template <typename Map>
double wall_rmse(std::uint32_t samples, Map map) {
    constexpr std::uint32_t kPixels = 1024;
    double squares = 0.0;
    for (std::uint32_t pixel = 0; pixel < kPixels; ++pixel) {
        test::TestRandom random(pixel);
        const test::WallCorner wall{.angle = random.uniform(0.0, 2.0 * kPi),
                                    .height = random.uniform(0.3, 3.0)};
        double sum = 0.0;
        for (std::uint32_t i = 0; i < samples; ++i)
            sum += wall.visible(map(gpu::sample_2d(gpu::kSequenceSobol, {pixel, i, 2}, 0)));
        squares += std::pow(sum / samples - wall.mean(), 2.0);
    }
    return std::sqrt(squares / kPixels);
}

TEST(Sampling, concentric_map_has_no_more_ao_error_than_the_polar_map) {
    for (const std::uint32_t samples : {16u, 64u, 256u, 1024u}) {
        const double concentric = wall_rmse(samples, gpu::cosine_hemisphere);
        const double polar = wall_rmse(samples, polar_hemisphere);
        std::printf("AO RMSE at %4u samples: concentric %.3e, polar %.3e\n", samples, concentric, polar);
        EXPECT_LE(concentric, polar);
    }
}

}  // namespace
}  // namespace voxilux
