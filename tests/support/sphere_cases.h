#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include <glm/glm.hpp>

#include "shared/sphere.h"
#include "support/statistics.h"

namespace voxilux::test {

struct SphereCase {
    gpu::Sphere sphere;
    glm::vec3 origin;
    glm::vec3 direction;
    float t_min;
    float t_max;
};

// A vector of doubles wide enough to serve as truth for a radius of 1e6 (64 bits of mantissa).
struct Wide3 {
    long double x, y, z;
};
inline Wide3 wide(glm::vec3 v) {
    return {v.x, v.y, v.z};
}
inline long double dot(Wide3 a, Wide3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Wide3 add_scaled(Wide3 a, long double s, Wide3 b) {
    return {a.x + s * b.x, a.y + s * b.y, a.z + s * b.z};
}

struct WideHit {
    bool hit = false;
    long double t = 0.0L;
    Wide3 normal{0.0L, 0.0L, 1.0L};
    long double discriminant = 0.0L;  // 1 - (distance of line and centre)^2 / R^2
};

// First crossing by centre and radius, with neither the curvature form nor a float: the sphere that the
// stored anchor, normal and curvature name has centre anchor - normal / k and passes through the anchor.
inline WideHit intersect_wide(const SphereCase& c) {
    const Wide3 anchor = wide(c.sphere.anchor);
    const Wide3 centre = add_scaled(anchor, -1.0L / c.sphere.curvature, wide(c.sphere.normal));
    const Wide3 from_centre = add_scaled(wide(c.origin), -1.0L, centre);
    const Wide3 to_anchor = add_scaled(anchor, -1.0L, centre);
    const Wide3 d = wide(c.direction);
    const long double radius2 = dot(to_anchor, to_anchor);
    const long double closest = -dot(from_centre, d) / dot(d, d);
    const Wide3 middle = add_scaled(from_centre, closest, d);
    WideHit result;
    result.discriminant = 1.0L - dot(middle, middle) / radius2;
    if (result.discriminant < 0.0L) return result;
    const long double half_chord = std::sqrt(result.discriminant * radius2 / dot(d, d));
    for (const long double t : {closest - half_chord, closest + half_chord}) {
        if (t < c.t_min || t > c.t_max) continue;
        const Wide3 point = add_scaled(from_centre, t, d);
        const long double length = std::sqrt(dot(point, point));
        return {true, t, {point.x / length, point.y / length, point.z / length}, result.discriminant};
    }
    return result;
}

// Distance from a hit at t to the surface of the sphere, in voxels.
inline double surface_distance(const SphereCase& c, float t) {
    const Wide3 q =
        add_scaled(add_scaled(wide(c.origin), -1.0L, wide(c.sphere.anchor)), t, wide(c.direction));
    const Wide3 n = wide(c.sphere.normal);
    const long double k = c.sphere.curvature;
    // The implicit function divided by twice the length of its gradient.
    const Wide3 gradient = add_scaled(n, k, q);
    return static_cast<double>((k * dot(q, q) + 2.0L * dot(q, n)) /
                               (2.0L * std::sqrt(dot(gradient, gradient))));
}

// Longest of the lengths whose rounding moves a hit: from the anchor to the origin and on to the hit.
inline double hit_scale(const SphereCase& c, double t) {
    return static_cast<double>(glm::length(glm::dvec3(c.origin) - glm::dvec3(c.sphere.anchor))) + std::abs(t);
}

inline glm::dvec3 random_unit(TestRandom& random) {
    for (;;) {
        const glm::dvec3 v(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
        const double length = glm::length(v);
        if (length > 0.1 && length < 1.0) return v / length;
    }
}

// A direction that passes the centre at 1 - 10^-1 ... 1 - 10^-6 or 1 + as much radii, for an origin outside.
inline glm::dvec3 grazing_direction(TestRandom& random, glm::dvec3 to_centre, double radius) {
    const double distance = glm::length(to_centre);
    const double gap = std::pow(10.0, random.uniform(-6.0, -1.0)) * (random.bits32() % 4 == 0 ? 1.0 : -1.0);
    const double sine = std::min(1.0, radius * (1.0 + gap) / distance);
    const glm::dvec3 side = glm::normalize(glm::cross(to_centre, random_unit(random)));
    return std::sqrt(1.0 - sine * sine) / distance * to_centre + sine * side;
}

// Radii from 1e-3 to 1e6. Origins 1e-3 to 100 radii from the anchor, but 0.01 to 1000 voxels, inside and
// outside; directions random, aimed near the anchor, or grazing.
inline std::vector<SphereCase> sphere_cases(int count) {
    TestRandom random(11);
    std::vector<SphereCase> cases;
    for (int i = 0; i < count; ++i) {
        const double radius = std::pow(10.0, random.uniform(-3.0, 6.0));
        const double reach = std::clamp(radius * std::pow(10.0, random.uniform(-3.0, 2.0)), 1e-2, 1000.0);
        const glm::dvec3 near = random_unit(random) * random.uniform(0.0, 100.0);
        const glm::dvec3 centre = near - random_unit(random) * radius;
        SphereCase c{
            .sphere = gpu::sphere_anchored_near(centre, radius, near), .t_min = 0.0f, .t_max = 1e30f};
        c.origin = glm::vec3(glm::dvec3(c.sphere.anchor) + reach * random_unit(random));
        const glm::dvec3 aim = glm::dvec3(c.sphere.anchor) + std::min(radius, reach) * random_unit(random);
        const glm::dvec3 to_centre = centre - glm::dvec3(c.origin);
        glm::dvec3 direction = random_unit(random);
        if (i % 3 == 1) direction = glm::normalize(aim - glm::dvec3(c.origin));
        if (i % 3 == 2 && glm::length(to_centre) > radius)
            direction = grazing_direction(random, to_centre, radius);
        c.direction = glm::vec3(direction);
        cases.push_back(c);
    }
    return cases;
}

// A few roundings of 2^-24: the bound of every error below, in the unit named there.
inline constexpr double kSphereError = 5.0e-7;

// Errors of a hit, each as a multiple of what rounding may do: right if at most 1.
struct SphereErrors {
    double missed = 0.0;   // distance of the discriminant from 0 where the hit flags differ
    double surface = 0.0;  // distance from the sphere
    double t = 0.0;
    double normal = 0.0;

    [[nodiscard]] double worst() const { return std::max({missed, surface, t, normal}); }
};

// Compares with intersect_wide(). Rounding moves the ray across by about scale = |origin - anchor| + t times
// 2^-24; near a tangent that moves t and the normal by 1 / sqrt(discriminant) as much.
inline SphereErrors sphere_errors(const SphereCase& c, const gpu::SphereHit& got) {
    const WideHit want = intersect_wide(c);
    const double scale = hit_scale(c, got.hit ? static_cast<double>(got.t) : 0.0);
    const double radii = 1.0 + scale * static_cast<double>(c.sphere.curvature);
    const double discriminant = static_cast<double>(want.discriminant);
    SphereErrors errors;
    if (got.hit != want.hit) errors.missed = std::abs(discriminant) / (radii * kSphereError);
    if (!got.hit || !want.hit) return errors;
    const double root = std::sqrt(discriminant);
    const Wide3 normal_error = add_scaled(want.normal, -1.0L, wide(got.normal));
    errors.surface = std::abs(surface_distance(c, got.t)) / (scale * kSphereError);
    errors.t = static_cast<double>(std::abs(got.t - want.t)) * root / (scale * kSphereError);
    errors.normal =
        std::sqrt(static_cast<double>(dot(normal_error, normal_error))) * root / (radii * kSphereError);
    return errors;
}

}  // namespace voxilux::test
