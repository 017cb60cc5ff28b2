// The pass sun.trace against closed forms: cosines, hard shadows, and the visible fraction of the sun's disc
// over an edge.

#include <gtest/gtest.h>

#include <numbers>

#include "shared/sampling.h"
#include "support/frame_fixture.h"
#include "support/occlusion_forms.h"
#include "support/test_scenes.h"

namespace voxilux {
namespace {

// Standard deviations of a binomial count: 1 in 16,000 by chance, and the seeds are fixed.
constexpr double kSigmas = 4.0;
// Voxels around the edge of a hard shadow where rounding decides: 2^-23 of 40 voxels, several times over.
constexpr double kEdge = 1e-4;

constexpr int kWallFoot = 4;  // the wall's near side, x
constexpr int kWallTop = 5;

double radians(double degrees) {
    return degrees * std::numbers::pi / 180.0;
}

Scene sunny_floor() {
    Scene scene = test::white_scene();
    test::add_box(scene, {-40, -40, -1}, {40, 40, 0});
    scene.sun = {.azimuth_deg = 0.0f, .elevation_deg = 40.0f, .angular_diameter_deg = 0.0f};
    scene.sun.irradiance = glm::vec3(1.0f);
    scene.settings.size = {24, 24};
    return scene;
}

glm::dvec3 position_of(const test::FrameFixture& fixture, const gpu::Hit& hit) {
    return glm::dvec3(fixture.march_world().origin + hit.cell) + glm::dvec3(hit.fraction);
}

TEST(SunTrace, open_faces_get_exactly_the_cosine_and_faces_turned_away_nothing) {
    for (const glm::vec2 angles : {glm::vec2(37, 25), {200, 60}, {90, 5}, {0, 90}, {315, 0.001f}}) {
        Scene scene = test::white_scene();
        test::add_box(scene, {-2, -3, 0}, {3, 2, 4});
        scene.sun = {.azimuth_deg = angles.x, .elevation_deg = angles.y, .angular_diameter_deg = 0.0f};
        scene.settings.size = {32, 24};
        for (const glm::dvec3 eye : {glm::dvec3(9, -11, 10), {-9, 10, -6}}) {
            scene.camera = test::camera_towards(eye, {0, 0, 2});
            const test::FramePlanes planes = test::render_first_sample(scene);
            const glm::vec3 to_sun = scene.sun.direction();
            for (std::size_t i = 0; i < planes.hits.size(); ++i) {
                const gpu::uint face = planes.hits[i].face;
                const float cosine = face < 6u ? glm::dot(gpu::face_normal(face), to_sun) : 0.0f;
                ASSERT_EQ(planes.sun[i], std::max(cosine, 0.0f)) << "face " << face << " sun " << angles.x;
            }
        }
    }
}

Scene walled_floor(float angular_diameter_deg) {
    Scene scene = sunny_floor();
    test::add_box(scene, {kWallFoot, -40, 0}, {kWallFoot + 1, 40, kWallTop});
    scene.sun.angular_diameter_deg = angular_diameter_deg;
    scene.camera = test::camera_down({-2.0, 0.0, 40.0}, 15.0);
    return scene;
}

TEST(SunTrace, hard_shadow_ends_where_the_wall_top_hides_the_sun) {
    test::FrameFixture fixture(walled_floor(0.0f));
    const test::FramePlanes planes = fixture.render(0);
    const double reach = kWallTop / std::tan(radians(40.0));  // of the shadow along the floor
    int lit = 0;
    int dark = 0;
    for (std::size_t i = 0; i < planes.hits.size(); ++i) {
        const double before_wall = kWallFoot - position_of(fixture, planes.hits[i]).x;
        if (before_wall <= 0.0 || std::abs(before_wall - reach) < kEdge) continue;
        ASSERT_EQ(planes.sun[i] > 0.0f, before_wall > reach) << before_wall;
        (before_wall > reach ? lit : dark) += 1;
    }
    EXPECT_GT(lit, 100);
    EXPECT_GT(dark, 100);
}

TEST(SunTrace, sphere_under_a_sun_in_the_zenith_shadows_a_disc_of_its_radius) {
    Scene scene = sunny_floor();
    scene.sun.elevation_deg = 90.0f;
    scene.spheres.push_back({glm::dvec3(0.25, 0.5, 7.0), 2.5, 0});
    scene.camera = test::camera_towards({0.0, -14.0, 4.0}, {0.25, 0.5, 0.0}, 40.0);
    test::FrameFixture fixture(scene);
    const test::FramePlanes planes = fixture.render(0);
    int dark = 0;
    for (std::size_t i = 0; i < planes.hits.size(); ++i) {
        if (planes.hits[i].face != 5u) continue;
        const glm::dvec3 p = position_of(fixture, planes.hits[i]);
        const double distance = std::hypot(p.x - 0.25, p.y - 0.5);
        if (std::abs(distance - 2.5) < kEdge) continue;
        ASSERT_EQ(planes.sun[i] > 0.0f, distance > 2.5) << distance;
        dark += distance < 2.5 ? 1 : 0;
    }
    EXPECT_GT(dark, 20);
}

// Share of a cap of directions within `radius` of a centre that lies above a plane, the sine of the centre's
// height over the plane being `height`: at distance a from the centre, a share acos(-c) / pi of the circle is
// above, c = cos a height / (sin a sqrt(1 - height^2)).
double cap_share_above(double radius, double height) {
    const double flat = std::sqrt(1.0 - height * height);
    const auto on_circle = [&](double a) {
        const double c = std::cos(a) * height / (std::sin(a) * flat);
        return std::sin(a) * std::acos(std::clamp(-c, -1.0, 1.0)) / std::numbers::pi;
    };
    const double above = test::integrate(0.0, radius, on_circle, 500);
    return above / (1.0 - std::cos(radius));
}

struct Penumbra {
    double sigmas = 0.0;  // by which the lit samples stray from the shares
    int inside = 0;       // samples in the penumbra
    int wrong = 0;        // lit samples where no sun is in sight, dark ones where all of it is
};

// The edge of the wall's top and a point of the floor span a plane; the part of the sun's disc above it is
// visible. The disc's centre is above the plane by elevation minus the angle to the edge. `shift` perturbs
// the point.
Penumbra measure_penumbra(Sequence sequence, double shift) {
    constexpr double kSunRadius = 4.0;  // degrees
    Scene scene = walled_floor(static_cast<float>(2.0 * kSunRadius));
    scene.settings.sequence = sequence;
    test::FrameFixture fixture(scene);
    Penumbra penumbra;
    double difference = 0.0;
    double variance = 0.0;
    for (std::uint32_t sample = 0; sample < 16; ++sample) {
        const test::FramePlanes planes = fixture.render(sample);
        for (std::size_t i = 0; i < planes.hits.size(); ++i) {
            const double before_wall = kWallFoot - position_of(fixture, planes.hits[i]).x + shift;
            if (planes.hits[i].face != 5u || before_wall <= 0.0) continue;
            const double over = radians(40.0) - std::atan(kWallTop / before_wall);
            const bool is_lit = planes.sun[i] > 0.0f;
            if (std::abs(over) > radians(kSunRadius) + kEdge) {
                penumbra.wrong += is_lit != (over > 0.0) ? 1 : 0;
                continue;
            }
            const double share = cap_share_above(radians(kSunRadius), std::sin(over));
            ++penumbra.inside;
            difference += (is_lit ? 1.0 : 0.0) - share;
            variance += share * (1.0 - share);
        }
    }
    penumbra.sigmas = difference / std::sqrt(variance);
    return penumbra;
}

TEST(SunTrace, penumbra_is_as_wide_as_the_sun_and_dims_as_its_disc_sets) {
    for (const Sequence sequence : {Sequence::white, Sequence::sobol, Sequence::halton}) {
        const Penumbra penumbra = measure_penumbra(sequence, 0.0);
        EXPECT_EQ(penumbra.wrong, 0);
        EXPECT_GT(penumbra.inside, 1000);
        EXPECT_LT(std::abs(penumbra.sigmas), kSigmas);
    }
}

TEST(SunTrace, comparison_rejects_a_penumbra_moved_by_a_quarter_voxel) {
    const Penumbra penumbra = measure_penumbra(Sequence::white, 0.25);
    EXPECT_GT(penumbra.wrong, 0);
    EXPECT_GT(std::abs(penumbra.sigmas), 2.0 * kSigmas);
}

// The mean cosine over a cap of half angle r around a centre at elevation e, all of it above the plane, is
// sin(e) (1 + cos r) / 2.
TEST(SunTrace, mean_over_a_soft_sun_is_the_cosine_of_its_cap) {
    Scene scene = sunny_floor();
    scene.sun.elevation_deg = 30.0f;
    scene.sun.angular_diameter_deg = 20.0f;
    scene.settings.sequence = Sequence::white;
    scene.camera = test::camera_down({0, 0, 20}, 30.0);
    test::FrameFixture fixture(scene);
    double sum = 0.0;
    double squares = 0.0;
    double count = 0.0;
    for (std::uint32_t sample = 0; sample < 32; ++sample) {
        for (const float lit : fixture.render(sample).sun) {
            sum += static_cast<double>(lit);
            squares += static_cast<double>(lit) * static_cast<double>(lit);
            count += 1.0;
        }
    }
    const double mean = sum / count;
    const double deviation = std::sqrt((squares / count - mean * mean) / count);
    EXPECT_NEAR(mean, std::sin(radians(30.0)) * (1.0 + std::cos(radians(10.0))) / 2.0, kSigmas * deviation);
    EXPECT_LT(deviation, 1e-3);
}

// A disc cut by the horizon lights the floor with the part above it, and only rays above the face are
// marched.
TEST(SunTrace, sun_half_below_the_horizon_lights_half_the_samples) {
    Scene scene = sunny_floor();
    scene.sun.elevation_deg = 1e-6f;
    scene.sun.angular_diameter_deg = 6.0f;
    scene.camera = test::camera_down({0, 0, 20}, 30.0);
    test::FrameFixture fixture(scene);
    int lit = 0;
    int count = 0;
    for (std::uint32_t sample = 0; sample < 16; ++sample) {
        const test::FramePlanes planes = fixture.render(sample);
        int lit_now = 0;
        for (const float value : planes.sun) {
            ASSERT_GE(value, 0.0f);
            lit_now += value > 0.0f ? 1 : 0;
        }
        EXPECT_EQ(planes.counters[gpu::kWorkSunRays], static_cast<gpu::uint>(lit_now));
        lit += lit_now;
        count += static_cast<int>(planes.sun.size());
    }
    EXPECT_NEAR(lit, count / 2.0, kSigmas * std::sqrt(count / 4.0));
}

TEST(SunTrace, camera_inside_a_solid_sees_no_sun) {
    Scene scene = sunny_floor();
    scene.camera = Camera{.position = glm::dvec3(0.5, 0.5, -0.5)};
    const test::FramePlanes planes = test::render_first_sample(scene);
    for (const float lit : planes.sun)
        ASSERT_EQ(lit, 0.0f);
}

}  // namespace
}  // namespace voxilux
