// A smooth surface between two transparent media. With c = cos of the angle of incidence and eta = n_far /
// n_near, everything follows from g = eta cos(angle of refraction) = sqrt(eta^2 - 1 + c^2): Snell's law,
// Fresnel's equations, and total reflection where the root is not real. Source: Born and Wolf 1999,
// "Principles of Optics", 7th edition, section 1.5.2, eqs. 21 and 22. We differ in that g^2 is summed in two
// floats and differences of nearly equal numbers are factored out, so that the critical angle is decided
// exactly and eta = 1 changes nothing.
//
// Radiance across a surface changes by 1 / eta^2, because a lossless surface preserves radiance / n^2. A path
// that starts at the camera multiplies by radiance_scale() at each refraction; photons carry power and do
// not. Source: Veach 1997, "Robust Monte Carlo Methods for Light Transport Simulation", section 5.2.
#ifndef VX_DIELECTRIC_H
#define VX_DIELECTRIC_H

#include "limits.h"
#include "portable.h"
#include "two_float.h"

VX_BEGIN

struct Dielectric {
    float reflectance;  // of unpolarised light, in [0, 1]; what is not reflected is transmitted
    float bend;         // c - g, see refracted_direction
    bool is_total;      // total internal reflection: there is no refracted direction
};

// Reflection and refraction for cos_incidence in [0, 1] and eta = n_far / n_near in [1 / kMaxEta, kMaxEta];
// values outside are clamped. Never NaN. The reflectance is exactly 0 for eta = 1.
VX_FN Dielectric dielectric(float cos_incidence, float eta) {
    float c = cos_incidence > 0.0f ? min(cos_incidence, 1.0f) : 0.0f;
    float n = eta > 1.0f / kMaxEta ? min(eta, kMaxEta) : 1.0f / kMaxEta;
    TwoFloat n2 = two_prod(n, n);
    TwoFloat gap = tf_add(n2, two_float(-1.0f, 0.0f));  // eta^2 - 1
    TwoFloat g2 = tf_add(gap, two_prod(c, c));
    Dielectric result;
    result.reflectance = n == 1.0f ? 0.0f : 1.0f;
    result.bend = 0.0f;
    result.is_total = g2.hi <= 0.0f && n != 1.0f;
    if (g2.hi <= 0.0f || n == 1.0f) return result;

    float g = sqrt(g2.hi);
    VX_PRECISE float sum = c + g;
    VX_PRECISE float bend = -gap.hi / sum;  // c - g = (c^2 - g^2) / (c + g)
    VX_PRECISE float across = bend / sum;
    VX_PRECISE float plus = n2.hi * c + g;
    VX_PRECISE float within = (n2.hi * c - g) / plus;
    VX_PRECISE float reflected = 0.5f * (across * across + within * within);
    VX_PRECISE float transmitted = 2.0f * c * g * (1.0f / (sum * sum) + n2.hi / (plus * plus));
    // The smaller of the two has the smaller rounding error.
    result.reflectance = transmitted < 0.5f ? 1.0f - transmitted : reflected;
    result.bend = bend;
    return result;
}

// v, whose length is nearly 1, normalized.
VX_FN vec3 trimmed(vec3 v) {
    VX_PRECISE vec3 unit = v / sqrt(dot(v, v));
    return unit;
}

// Unit direction behind the surface. `direction` is unit, `normal` unit and on the side that the ray comes
// from, surface = dielectric(-dot(direction, normal), eta), not total. With eta = 1 it is `direction` to the
// bit.
VX_FN vec3 refracted_direction(vec3 direction, vec3 normal, float eta, Dielectric surface) {
    if (eta == 1.0f) return direction;
    VX_PRECISE vec3 v = (direction + surface.bend * normal) / eta;
    return trimmed(v);
}

// Unit direction of the mirror reflection; `direction` and `normal` are unit.
VX_FN vec3 mirror_direction(vec3 direction, vec3 normal) {
    VX_PRECISE float c = dot(direction, normal);
    VX_PRECISE vec3 v = direction - (2.0f * c) * normal;
    return trimmed(v);
}

// The factor on the radiance of a path from the camera that is refracted into a medium of eta = n_far /
// n_near.
VX_FN float radiance_scale(float eta) {
    return 1.0f / (eta * eta);
}

VX_END

#endif
