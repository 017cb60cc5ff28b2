// The air between the camera and a surface, against quadrature in double precision along straight lines past
// a sphere.

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "support/hard_airs.h"
#include "support/sky_model.h"

#define VX_SKY_PARAM const std::vector<::voxilux::gpu::uvec4>&scatter,
#define VX_SKY_ARG scatter,
#include "shared/aerial.h"
#undef VX_SKY_PARAM
#undef VX_SKY_ARG

namespace voxilux {
namespace {

using glm::dvec3;
using glm::vec3;

constexpr double kPlanetRadius = 6360.0;

struct Line {
    double height;  // of its start, km
    dvec3 direction;

    [[nodiscard]] dvec3 at(double t) const { return dvec3(0.0, 0.0, kPlanetRadius + height) + t * direction; }
};

double height_of(dvec3 place) {
    return glm::length(place) - kPlanetRadius;
}

dvec3 extinction(const gpu::Air& air, double h) {
    return dvec3(air.rayleigh) * std::exp(-h / 8.0) + double{air.mie_extinction} * std::exp(-h / 1.2) +
           dvec3(air.ozone) * std::max(0.0, 1.0 - std::abs(h - 25.0) / 15.0);
}

dvec3 passes_between(const gpu::Air& air, dvec3 from, dvec3 way, int steps) {
    dvec3 depth(0.0);
    for (int i = 0; i < steps; ++i)
        depth += extinction(air, height_of(from + way * ((i + 0.5) / steps)));
    return glm::exp(-depth * (glm::length(way) / steps));
}

dvec3 sunlight_at(const gpu::Air& air, dvec3 place, dvec3 sun) {
    const double r = glm::length(place), along = glm::dot(place, sun);
    if (along < 0.0 && r * r - along * along < kPlanetRadius * kPlanetRadius) return dvec3(0.0);
    const double top = kPlanetRadius + 100.0;
    const double way = -along + std::sqrt(along * along + top * top - r * r);
    return passes_between(air, place, way * sun, 400);
}

struct Truth {
    dvec3 passes, light;
};

// Light scattered more than once is that of the table, looked up at each step.
Truth truth_of(const test::ScatterTable& scatter, const gpu::Air& air, const Line& line, dvec3 sun,
               double length) {
    constexpr int kSteps = 400;
    const dvec3 moments(gpu::mie_moments(air.mie_g));
    const double turn = glm::dot(line.direction, sun);
    const double aerosol_phase = double{gpu::mie_phase(air.mie_g, static_cast<float>(turn))};
    Truth truth{.passes = passes_between(air, line.at(0.0), length * line.direction, kSteps),
                .light = dvec3(0.0)};
    for (int i = 0; i < kSteps; ++i) {
        const double t = length * (i + 0.5) / kSteps;
        const dvec3 place = line.at(t), up = glm::normalize(place);
        const double h = height_of(place), mu = glm::dot(up, sun), cosine = glm::dot(up, line.direction);
        const dvec3 rayleigh = dvec3(air.rayleigh) * std::exp(-h / 8.0);
        const double aerosol = double{air.mie} * std::exp(-h / 1.2);
        const dvec3 once = (rayleigh * (3.0 / (16.0 * std::numbers::pi) * (1.0 + turn * turn)) +
                            dvec3(aerosol * aerosol_phase)) *
                           sunlight_at(air, place, sun);
        const gpu::SkyHarmonics arrives =
            gpu::scatter_lookup(scatter, static_cast<float>(h), static_cast<float>(mu));
        const double across = (turn - cosine * mu) / std::sqrt(std::max(1.0 - mu * mu, 1e-8));
        const dvec3 more(gpu::scattered_light(
            arrives, static_cast<float>(cosine), static_cast<float>(across), vec3(rayleigh + dvec3(aerosol)),
            vec3(dvec3(aerosol * moments.y)), vec3(0.1 * rayleigh + dvec3(aerosol * moments.z))));
        truth.light +=
            (length / kSteps) * passes_between(air, line.at(0.0), t * line.direction, 100) * (once + more);
    }
    return truth;
}

struct View {
    float height, elevation_deg, azimuth_deg, sun_deg;
    double length;  // km
    double error;   // of the added light, share: that of four points where the air changes along the ray
};

const View kViews[] = {{0.002f, 0.0f, 0.0f, 60.0f, 0.05, 0.001},   {0.002f, 1.0f, 90.0f, 10.0f, 1.0, 0.001},
                       {0.1f, 0.5f, 180.0f, 30.0f, 5.0, 0.002},    {0.5f, -3.0f, 45.0f, 5.0f, 8.0, 0.005},
                       {0.002f, 0.2f, 120.0f, 45.0f, 20.0, 0.005}, {2.0f, -1.5f, 60.0f, 20.0f, 60.0, 0.03},
                       {3.0f, 10.0f, 30.0f, -2.0f, 15.0, 0.03},    {0.01f, 0.0f, 20.0f, 2.0f, 100.0, 0.06}};

struct Found {
    gpu::Aerial aerial;
    Truth truth;
};

Found found_of(const View& view, double way_factor) {
    const gpu::Air air = test::earth();
    static const test::ScatterTable scatter = test::scatter_table(air);
    gpu::SkyParams sky = test::sky_of(air, view.height, view.sun_deg);
    sky.km_per_voxel = 0.001f;
    const vec3 direction = test::direction_of(double{view.azimuth_deg}, double{view.elevation_deg});
    const gpu::AirPart part =
        gpu::air_part(sky, direction, 0.0f, static_cast<float>(1000.0 * view.length * way_factor));
    return {gpu::aerial_of(scatter, air, part),
            truth_of(scatter, air, {double{view.height}, glm::normalize(dvec3(direction))},
                     glm::normalize(dvec3(sky.sun_direction)), view.length)};
}

int count_off(const View& view, double way_factor = 1.0) {
    const auto [aerial, truth] = found_of(view, way_factor);
    int off = 0;
    for (int c = 0; c < 3; ++c) {
        off += std::abs(double{aerial.passes[c]} / truth.passes[c] - 1.0) > 1e-3 ? 1 : 0;
        off += std::abs(double{aerial.light[c]} / truth.light[c] - 1.0) > view.error ? 1 : 0;
    }
    return off;
}

TEST(Aerial, light_and_transmittance_are_those_of_quadrature) {
    for (const View& view : kViews)
        EXPECT_EQ(count_off(view), 0) << view.length;
}

TEST(Aerial, way_that_is_a_tenth_longer_is_caught) {
    for (const View& view : kViews)
        EXPECT_GE(count_off(view, 1.1), 3) << view.length;
}

TEST(Aerial, nothing_between_changes_nothing) {
    const gpu::Air air = test::earth();
    const test::ScatterTable scatter(gpu::kScatterPairs, glm::uvec4(0));
    gpu::SkyParams sky = test::sky_of(air, 400.0f, 30.0f);
    sky.km_per_voxel = 1.0f;
    const auto of = [&](vec3 direction, float length) {
        return gpu::aerial_of(scatter, air, gpu::air_part(sky, direction, 0.0f, length));
    };
    for (const gpu::Aerial& aerial : {of({0.0f, 0.0f, -1.0f}, 299.0f), of({1.0f, 0.0f, 0.0f}, 1e6f)}) {
        EXPECT_EQ(aerial.passes, vec3(1.0f));  // in space: before the air, and past it
        EXPECT_EQ(aerial.light, vec3(0.0f));
    }
    EXPECT_LT(of({0.0f, 0.0f, -1.0f}, 390.0f).passes.z, 0.95f);
    sky.height = 0.1f;
    EXPECT_EQ(of({1.0f, 0.0f, 0.0f}, 0.0f).passes, vec3(1.0f));
}

TEST(Aerial, hard_cases_are_finite_and_let_no_more_than_all_light_pass) {
    for (const test::HardAir& hard : test::hard_airs()) {
        const test::ScatterTable scatter = test::scatter_table(hard.air, 0);
        for (const float height : test::kHardHeights) {
            for (const float sun : test::kHardSuns) {
                gpu::SkyParams sky = test::sky_of(hard.air, height, sun);
                sky.km_per_voxel = 1.0f;
                for (const float z : {-1.0f, -0.02f, 0.0f, 1e-6f, 1.0f}) {
                    for (const float length : {0.0f, 1e-6f, 10.0f, 1e9f}) {
                        const vec3 direction(std::sqrt(1.0f - z * z), 0.0f, z);
                        const gpu::Aerial aerial =
                            gpu::aerial_of(scatter, hard.air, gpu::air_part(sky, direction, 0.0f, length));
                        for (int c = 0; c < 3; ++c) {
                            ASSERT_TRUE(aerial.light[c] >= 0.0f && aerial.light[c] < 1e3f)
                                << hard.name << ' ' << height << ' ' << sun << ' ' << z << ' ' << length;
                            ASSERT_TRUE(aerial.passes[c] >= 0.0f && aerial.passes[c] <= 1.0f) << hard.name;
                        }
                    }
                }
            }
        }
    }
}

}  // namespace
}  // namespace voxilux
