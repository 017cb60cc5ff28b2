#include "shared/sphere.h"

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "support/sphere_cases.h"

namespace voxilux {
namespace {

using glm::dvec3;
using glm::vec3;
using gpu::Sphere;
using gpu::SphereHit;
using test::SphereCase;

constexpr float kFar = 1e30f;

SphereHit intersect(const SphereCase& c) {
    return gpu::sphere_intersect(c.sphere, c.origin, c.direction, c.t_min, c.t_max);
}

Sphere unit_sphere_seen_from(dvec3 near) {
    return gpu::sphere_anchored_near(dvec3(0.0), 1.0, near);
}

TEST(Sphere, first_crossing_from_outside_and_from_inside) {
    const Sphere sphere = unit_sphere_seen_from({-5, 0, 0});
    const SphereHit enter = gpu::sphere_intersect(sphere, vec3(-3, 0, 0), vec3(1, 0, 0), 0.0f, kFar);
    ASSERT_TRUE(enter.hit);
    EXPECT_EQ(enter.t, 2.0f);
    EXPECT_EQ(enter.normal, vec3(-1, 0, 0));
    const SphereHit leave = gpu::sphere_intersect(sphere, vec3(0.5f, 0, 0), vec3(1, 0, 0), 0.0f, kFar);
    ASSERT_TRUE(leave.hit);
    EXPECT_EQ(leave.t, 0.5f);
    EXPECT_EQ(leave.normal, vec3(1, 0, 0));
}

TEST(Sphere, interval_is_closed_and_an_empty_one_misses) {
    const Sphere sphere = unit_sphere_seen_from({-5, 0, 0});
    const vec3 origin(-3, 0, 0);
    const vec3 direction(1, 0, 0);
    EXPECT_TRUE(gpu::sphere_intersect(sphere, origin, direction, 2.0f, 2.0f).hit);
    EXPECT_EQ(gpu::sphere_intersect(sphere, origin, direction, 2.5f, kFar).t, 4.0f);
    EXPECT_FALSE(gpu::sphere_intersect(sphere, origin, direction, 0.0f, 1.9f).hit);
    EXPECT_FALSE(gpu::sphere_intersect(sphere, origin, direction, 5.0f, 1.0f).hit);
    EXPECT_FALSE(gpu::sphere_intersect(sphere, origin, -direction, 0.0f, kFar).hit);
}

TEST(Sphere, curvature_zero_is_a_plane) {
    const Sphere plane{.anchor = vec3(0, 0, 2), .curvature = 0.0f, .normal = vec3(0, 0, 1)};
    const vec3 slanted = glm::normalize(vec3(1, 0, -1));
    const SphereHit hit = gpu::sphere_intersect(plane, vec3(7, 7, 5), slanted, 0.0f, kFar);
    ASSERT_TRUE(hit.hit);
    EXPECT_FLOAT_EQ(hit.t, 3.0f * std::sqrt(2.0f));
    EXPECT_EQ(hit.normal, vec3(0, 0, 1));
    EXPECT_FALSE(gpu::sphere_intersect(plane, vec3(7, 7, 5), vec3(1, 0, 0), 0.0f, kFar).hit);
}

TEST(Sphere, hits_of_radius_1e_minus_3_to_1e6_equal_long_double_within_rounding) {
    int hits = 0;
    for (const SphereCase& c : test::sphere_cases(100000)) {
        const SphereHit got = intersect(c);
        const test::SphereErrors errors = test::sphere_errors(c, got);
        ASSERT_LE(errors.worst(), 1.0)
            << "radius " << 1.0f / c.sphere.curvature << " missed " << errors.missed << " surface "
            << errors.surface << " t " << errors.t << " normal " << errors.normal;
        hits += got.hit ? 1 : 0;
        EXPECT_NEAR(glm::length(dvec3(got.normal)), 1.0, gpu::kUnitLengthError);
    }
    EXPECT_GT(hits, 50000);
}

// The textbook form in float, with a big radius squared in it.
SphereHit intersect_textbook(const SphereCase& c) {
    const float radius = 1.0f / c.sphere.curvature;
    const vec3 centre = c.sphere.anchor - radius * c.sphere.normal;
    const vec3 q = c.origin - centre;
    const float b = glm::dot(q, c.direction);
    const float root = std::sqrt(b * b - (glm::dot(q, q) - radius * radius));
    SphereHit hit{.hit = false, .t = 0.0f, .normal = vec3(0, 0, 1)};
    for (const float t : {-b - root, -b + root}) {
        if (hit.hit || !(t >= c.t_min && t <= c.t_max)) continue;
        hit = {.hit = true, .t = t, .normal = (q + t * c.direction) / radius};
    }
    return hit;
}

TEST(Sphere, textbook_form_is_caught_on_big_spheres) {
    int wrong = 0;
    int total = 0;
    for (const SphereCase& c : test::sphere_cases(20000)) {
        if (c.sphere.curvature > 1e-4f) continue;
        ++total;
        wrong += test::sphere_errors(c, intersect_textbook(c)).worst() > 1.0 ? 1 : 0;
    }
    EXPECT_GT(wrong, total / 4);
}

TEST(Sphere, a_curvature_off_by_a_hundred_thousandth_is_caught) {
    int wrong = 0;
    for (const SphereCase& c : test::sphere_cases(2000)) {
        SphereCase moved = c;
        moved.sphere.curvature *= 1.00001f;
        wrong += test::sphere_errors(c, intersect(moved)).worst() > 1.0 ? 1 : 0;
    }
    EXPECT_GT(wrong, 100);
}

TEST(Sphere, hostile_inputs_never_give_nan) {
    const float inf = std::numeric_limits<float>::infinity();
    const std::vector<float> values = {0.0f,  -0.0f,  1.0f, -1.0f, 1e-30f,
                                       1e30f, 1e-40f, inf,  -inf,  std::nanf("")};
    test::TestRandom random(12);
    const auto pick = [&] { return values[random.bits32() % values.size()]; };
    const auto pick_vector = [&] { return vec3(pick(), pick(), pick()); };
    for (int i = 0; i < 200000; ++i) {
        const Sphere sphere{.anchor = pick_vector(), .curvature = std::abs(pick()), .normal = pick_vector()};
        const SphereHit hit = gpu::sphere_intersect(sphere, pick_vector(), pick_vector(), 0.0f, 1e20f);
        if (!hit.hit) continue;
        ASSERT_TRUE(hit.t >= 0.0f && hit.t <= 1e20f);
        ASSERT_NEAR(glm::length(hit.normal), 1.0f, 1e-5f);
    }
}

TEST(Sphere, far_origins_and_all_radii_never_give_nan) {
    for (const float radius : {1e-3f, 1.0f, 1e3f, 1e6f}) {
        for (const double distance : {0.0, 1.0, 1e3, 1e6, 1e9}) {
            const Sphere sphere = gpu::sphere_anchored_near(dvec3(0.0), radius, dvec3(distance, 0, 0));
            const vec3 origin(static_cast<float>(radius + distance), 0, 0);
            const SphereHit hit = gpu::sphere_intersect(sphere, origin, vec3(-1, 0, 0), 0.0f, kFar);
            ASSERT_TRUE(hit.hit) << radius << ' ' << distance;
            EXPECT_NEAR(hit.t, distance, 1e-6 * (distance + static_cast<double>(radius)));
            EXPECT_EQ(hit.normal, vec3(1, 0, 0));
        }
    }
}

TEST(Sphere, anchor_of_a_point_at_the_centre_is_the_top) {
    const Sphere sphere = gpu::sphere_anchored_near(dvec3(1, 2, 3), 4.0, dvec3(1, 2, 3));
    EXPECT_EQ(sphere.anchor, vec3(1, 2, 7));
    EXPECT_EQ(sphere.normal, vec3(0, 0, 1));
    EXPECT_EQ(sphere.curvature, 0.25f);
}

}  // namespace
}  // namespace voxilux
