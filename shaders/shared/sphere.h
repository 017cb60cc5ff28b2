// Ray against sphere in curvature form: the sphere is a point on it (the anchor), the outward unit normal
// there and the curvature k = 1/R, so R^2 is never formed and k = 0 is a plane. With q = origin - anchor the
// surface is k |p - anchor|^2 + 2 normal.(p - anchor) = 0 and its gradient, g(t) = normal + k (q + t d), has
// length 1 on it. We differ from the textbook in the discriminant and the normal, see sphere_discriminant and
// sphere_intersect.
#ifndef VX_SPHERE_H
#define VX_SPHERE_H

#include "limits.h"
#include "portable.h"

VX_BEGIN

struct Sphere {
    vec3 anchor;      // a point of the sphere, best the one nearest to the rays' origins; world voxels
    float curvature;  // 1 / radius, >= 0; 1 / voxel
    vec3 normal;      // outward, unit, at the anchor
};

struct SphereHit {
    bool hit;
    float t;      // in units of the direction, inside the given interval
    vec3 normal;  // outward, unit
};

#ifdef __cplusplus
// The sphere with a centre and a radius > 0, anchored at its point nearest to `near`; computed in double
// because a float cannot hold a big centre and a small anchor together. If `near` is the centre, the anchor
// is the top.
inline Sphere sphere_anchored_near(glm::dvec3 centre, double radius, glm::dvec3 near) {
    const glm::dvec3 away = near - centre;
    const double distance = glm::length(away);
    const glm::dvec3 normal = distance > 0.0 ? away / distance : glm::dvec3(0.0, 0.0, 1.0);
    return {.anchor = vec3(centre + radius * normal),
            .curvature = static_cast<float>(1.0 / radius),
            .normal = vec3(normal)};
}
#endif

// 1 - (distance of centre and line)^2 / R^2, >= 0 on a hit. b = g(0).d, kc = k (k q.q + 2 q.normal), across =
// the part of g(0) across the ray. b^2 - kc cancels when the origin is many radii away, 1 - |across|^2 when
// the ray starts near a big sphere; each is used where its terms are small. Second form: Haines et al. 2019,
// "Precision Improvements for Ray/Sphere Intersection", Ray Tracing Gems, chapter 7.
VX_FN float sphere_discriminant(float b, float kc, vec3 across) {
    VX_PRECISE float near_form = b * b - kc;
    VX_PRECISE float far_form = 1.0f - dot(across, across);
    return max(b * b, abs(kc)) < 1.0f ? near_form : far_form;
}

// A line that meets a sphere: it crosses at h / k, where k t + b = -s, and at c / h, where it is s. Neither
// subtracts equal numbers. The normal there is across -+ s d with s = k t + b = +-sqrt(discriminant), which
// has length 1 by construction and does not cancel as normal + k (p - anchor) does for a far small sphere.
struct SphereCrossing {
    vec3 across;
    float s;
    float t_h;
    float t_c;
    bool is_met;
};

VX_FN SphereCrossing sphere_crossing(Sphere sphere, vec3 origin, vec3 direction) {
    VX_PRECISE vec3 q = origin - sphere.anchor;
    VX_PRECISE vec3 gradient = sphere.normal + sphere.curvature * q;
    VX_PRECISE float b = dot(gradient, direction);
    VX_PRECISE float c = sphere.curvature * dot(q, q) + 2.0f * dot(q, sphere.normal);
    VX_PRECISE vec3 across = gradient - b * direction;
    float discriminant = sphere_discriminant(b, sphere.curvature * c, across);
    SphereCrossing crossing;
    crossing.is_met = discriminant >= 0.0f;
    float root = sqrt(max(discriminant, 0.0f));
    float s = b >= 0.0f ? root : -root;
    VX_PRECISE float h = -(b + s);
    VX_PRECISE float t_h = h / sphere.curvature;
    VX_PRECISE float t_c = c / h;
    crossing.across = across;
    crossing.s = s;
    crossing.t_h = t_h;
    crossing.t_c = t_c;
    return crossing;
}

// The first crossing with t_min <= t <= t_max, entering or leaving. direction is unit. A ray that only
// touches may miss; inputs that overflow or are not finite miss.
VX_FN SphereHit sphere_intersect(Sphere sphere, vec3 origin, vec3 direction, float t_min, float t_max) {
    SphereHit result;
    result.hit = false;
    result.t = t_max;
    result.normal = vec3(0.0f, 0.0f, 1.0f);
    SphereCrossing crossing = sphere_crossing(sphere, origin, direction);
    if (!crossing.is_met) return result;
    bool h_inside = crossing.t_h >= t_min && crossing.t_h <= t_max;
    bool c_inside = crossing.t_c >= t_min && crossing.t_c <= t_max;
    bool take_h = h_inside && !(c_inside && crossing.t_c <= crossing.t_h);
    if (!take_h && !c_inside) return result;

    VX_PRECISE vec3 normal = crossing.across + (take_h ? -crossing.s : crossing.s) * direction;
    VX_PRECISE float length_squared = dot(normal, normal);
    // Rejects overflow: NaN and infinity fail both comparisons.
    if (!(length_squared > 0.25f && length_squared < 4.0f)) return result;
    result.hit = true;
    result.t = take_h ? crossing.t_h : crossing.t_c;
    result.normal = normal / sqrt(length_squared);
    return result;
}

// The t of sphere_intersect() from t_min = 0, without the normal; t_max where there is no crossing before it.
// `starts_on` says that the ray starts on the sphere: that known crossing is left out, whatever the rounding
// of the origin.
VX_FN float sphere_time(Sphere sphere, vec3 origin, vec3 direction, float t_max, bool starts_on) {
    VX_PRECISE vec3 q = origin - sphere.anchor;
    VX_PRECISE vec3 gradient = sphere.normal + sphere.curvature * q;
    VX_PRECISE float b = dot(gradient, direction);
    VX_PRECISE float distance_form = sphere.curvature * dot(q, q) + 2.0f * dot(q, sphere.normal);
    float c = starts_on ? 0.0f : distance_form;
    VX_PRECISE vec3 across = gradient - b * direction;
    float discriminant = starts_on ? b * b : sphere_discriminant(b, sphere.curvature * c, across);
    float root = sqrt(max(discriminant, 0.0f));
    VX_PRECISE float h = -(b + (b >= 0.0f ? root : -root));
    VX_PRECISE float t_h = h / sphere.curvature;
    VX_PRECISE float t_c = c / h;
    float t = t_max;
    t = t_h >= 0.0f && t_h < t ? t_h : t;
    t = t_c >= 0.0f && t_c < t && !starts_on ? t_c : t;
    return discriminant >= 0.0f ? t : t_max;
}

// Whether a point is inside: k |q|^2 + 2 q.normal < 0. On the surface, rounding decides.
VX_FN bool is_in_sphere(Sphere sphere, vec3 point) {
    VX_PRECISE vec3 q = point - sphere.anchor;
    VX_PRECISE float f = sphere.curvature * dot(q, q) + 2.0f * dot(q, sphere.normal);
    return f < 0.0f;
}

// Outward unit normal at a point of the sphere.
VX_FN vec3 sphere_normal(Sphere sphere, vec3 point) {
    return normalize(sphere.normal + sphere.curvature * (point - sphere.anchor));
}

VX_END

#endif
