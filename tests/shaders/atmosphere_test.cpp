// The air against closed forms and quadrature in double precision, and the places where floats go wrong.

#include "shared/atmosphere.h"

#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace voxilux {
namespace {

using glm::dvec3;
using glm::vec3;

constexpr double kRadius = 6360.0;  // km
constexpr double kPiD = std::numbers::pi;

// Of a column, relative to itself or to the vertical one, whichever is larger: 0.05 % of a transmittance
// where the optical depth is 10.
constexpr double kColumnError = 5e-5;

double height_at(double h, double cosine, double t) {
    const double r = kRadius + h;
    const double gain = t * (2.0 * r * cosine + t);
    return h + gain / (r + std::sqrt(r * r + gain));
}

dvec3 densities_at(double h) {
    return {std::exp(-h / 8.0), std::exp(-h / 1.2), std::max(0.0, 1.0 - std::abs(h - 25.0) / 15.0)};
}

// Up to 400 km, where nothing is left; from a place with a cosine >= 0. Midpoints, dense at the start.
dvec3 quadrature_up(double h, double cosine) {
    const double r = kRadius + h;
    const double rise = 400.0 - h;
    const double end = std::sqrt(r * r * cosine * cosine + rise * (2.0 * r + rise)) - r * cosine;
    constexpr int kSteps = 40000;
    dvec3 sum(0.0);
    for (int i = 0; i < kSteps; ++i) {
        const double u = (i + 0.5) / kSteps;
        sum += densities_at(height_at(h, cosine, end * u * u)) * (2.0 * u * end / kSteps);
    }
    return sum;
}

TEST(Atmosphere, columns_agree_with_quadrature_from_the_ground_to_the_top_and_down_to_the_horizon) {
    for (const double h : {0.0, 0.002, 0.3, 5.0, 17.0, 25.0, 33.0, 60.0, 99.9}) {
        for (const double cosine : {0.0, 1e-6, 1e-3, 0.01, 0.05, 0.2, 0.6, 1.0}) {
            const dvec3 expected = quadrature_up(h, cosine);
            const vec3 column = gpu::columns_up(static_cast<float>(h), static_cast<float>(cosine));
            for (int i = 0; i < 3; ++i) {
                const double vertical = std::array{8.0, 1.2, 15.0}.at(static_cast<std::size_t>(i));
                ASSERT_NEAR(double{column[i]}, expected[i], kColumnError * std::max(expected[i], vertical))
                    << "h " << h << " cosine " << cosine << " component " << i;
            }
        }
    }
}

// Without the second-order part, the horizontal column corresponds to a radius that is 3/8 of a scale height
// too small: 0.05 %.
TEST(Atmosphere, first_order_of_the_chapman_function_is_caught) {
    const double expected = quadrature_up(0.0, 0.0).x;
    const double first_order = 8.0 * std::sqrt(kPiD / 2.0 * kRadius / 8.0);
    EXPECT_GT(std::abs(first_order / expected - 1.0), 4.0 * kColumnError);
}

TEST(Atmosphere, zenith_transmittance_is_the_closed_form) {
    const gpu::Air air{
        {5.802e-3f, 13.558e-3f, 33.1e-3f}, {0.65e-3f, 1.881e-3f, 0.085e-3f}, 3.996e-3f, 4.44e-3f, 0.8f, 0.3f};
    const vec3 passes = gpu::transmittance_out(air, 0.0f, 1.0f);
    for (int i = 0; i < 3; ++i) {
        const double depth = double{air.rayleigh[i]} * 8.0 + 4.44e-3 * 1.2 + double{air.ozone[i]} * 15.0;
        EXPECT_NEAR(double{passes[i]}, std::exp(-depth), 2e-6);
    }
    EXPECT_EQ(gpu::transmittance_out(air, 0.0f, -0.001f), vec3(0.0f));
}

// Rays within a few float steps of the horizon: whether each meets the ground, in double.
int wrong_sides(double h, auto&& hits) {
    const double horizon = -std::sqrt(h * (2.0 * kRadius + h)) / (kRadius + h);
    int wrong = 0;
    for (int i = -2000; i <= 2000; ++i) {
        const auto cosine = static_cast<float>(horizon * (1.0 + i * 1e-6));
        const double b = (kRadius + h) * double{cosine};
        const double slack = b * b - h * (2.0 * kRadius + h);
        if (std::abs(slack) < 1e-6 * b * b) continue;  // the roundings of the inputs decide
        wrong += hits(static_cast<float>(h), cosine) != (slack >= 0.0) ? 1 : 0;
    }
    return wrong;
}

TEST(Atmosphere, grazing_views_at_the_horizon_know_the_ground) {
    for (const double h : {0.002, 0.2, 5.0, 50.0})
        EXPECT_EQ(wrong_sides(h, [](float a, float b) { return gpu::hits_ground(a, b); }), 0) << h;
}

TEST(Atmosphere, quadratic_of_radii_is_caught_at_the_horizon) {
    const auto by_radius = [](float h, float cosine) {
        const float r = 6360.0f + h;
        return r * r * (cosine * cosine - 1.0f) + 6360.0f * 6360.0f >= 0.0f;
    };
    EXPECT_GT(wrong_sides(0.002, by_radius), 100);
}

TEST(Atmosphere, heights_keep_their_bits_near_the_ground) {
    double worst = 0.0, worst_by_radius = 0.0;
    for (const double t : {1e-5, 1e-4, 1e-3, 0.01, 0.1}) {  // thin segments, km
        for (const double h : {0.0, 0.0001, 0.002}) {
            const double gain = height_at(h, 0.3, t) - h;
            const auto by_height =
                double{gpu::height_after(static_cast<float>(h), 0.3f, static_cast<float>(t))};
            worst = std::max(worst, std::abs(by_height - h - gain) / gain);
            const float r = 6360.0f + static_cast<float>(h), d = static_cast<float>(t);
            const float by_radius = std::sqrt(r * r + 2.0f * r * 0.3f * d + d * d) - 6360.0f;
            worst_by_radius = std::max(worst_by_radius, std::abs(double{by_radius} - h - gain) / gain);
        }
    }
    EXPECT_LT(worst, 1e-4);
    EXPECT_GT(worst_by_radius, 1.0);
}

// Means of the phase function times Legendre's polynomials of degree 0, 1 and 2 over the sphere.
dvec3 moments(auto&& phase) {
    constexpr int kSteps = 400000;
    dvec3 sum(0.0);
    for (int i = 0; i < kSteps; ++i) {
        const double u = (i + 0.5) / kSteps;
        const double c = 1.0 - 2.0 * u * u * u * (10.0 - 15.0 * u + 6.0 * u * u);  // dense at both ends
        const double slope = 60.0 * u * u * (1.0 - u) * (1.0 - u);
        sum +=
            2.0 * kPiD * phase(static_cast<float>(c)) * dvec3(1.0, c, 1.5 * c * c - 0.5) * (slope / kSteps);
    }
    return sum;
}

TEST(Atmosphere, phase_functions_have_the_moments_that_we_multiply_by) {
    const dvec3 rayleigh = moments([](float c) { return double{gpu::rayleigh_phase(c)}; });
    EXPECT_NEAR(rayleigh.x, 1.0, 1e-5);
    EXPECT_NEAR(rayleigh.y, 0.0, 1e-5);
    EXPECT_NEAR(rayleigh.z, 0.1, 1e-5);
    for (const float g : {-0.9f, -0.5f, 0.0f, 0.5f, 0.8f, 0.9f}) {
        const dvec3 mie = moments([&](float c) { return double{gpu::mie_phase(g, c)}; });
        const vec3 closed = gpu::mie_moments(g);
        for (int i = 0; i < 3; ++i)
            EXPECT_NEAR(mie[i], double{closed[i]}, 1e-3) << "g " << g << " degree " << i;
    }
}

TEST(Atmosphere, phase_of_extreme_g_is_finite_and_positive) {
    for (const float g : {-0.99f, 0.99f}) {
        for (const float c : {-1.0f, -0.5f, 0.0f, 0.5f, 1.0f}) {
            EXPECT_TRUE(std::isfinite(gpu::mie_phase(g, c)));
            EXPECT_GT(gpu::mie_phase(g, c), 0.0f);
        }
    }
}

}  // namespace
}  // namespace voxilux
