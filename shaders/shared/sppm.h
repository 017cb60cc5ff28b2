// The arithmetic of progressive photon mapping with one radius per iteration, which depends on the index of
// the iteration alone: iterations are independent and may run in any order, anywhere. Source: Knaus and
// Zwicker 2011, "Progressive Photon Mapping: A Probabilistic Approach", ACM TOG 30(3), eq. 18.
#ifndef VX_SPPM_H
#define VX_SPPM_H

#include "limits.h"
#include "photon_types.h"
#include "portable.h"
#include "sampling.h"

VX_BEGIN

#ifdef __cplusplus
// Radius of iteration 1, 2, ..., in the units of `first` > 0, for alpha in (0, 1]: r_i^2 = r_(i-1)^2 (i - 1 +
// alpha) / i, as gamma functions: first^2 Gamma(i + alpha) / (Gamma(1 + alpha) Gamma(i + 1)). Relative error
// below 1e-8 up to 2^32 iterations. Never below kMinPhotonRadius.
inline double photon_radius(double first, double alpha, std::uint32_t iteration) {
    const double i = iteration;
    const double log_square = std::lgamma(i + alpha) - std::lgamma(i + 1.0) - std::lgamma(1.0 + alpha);
    return max(first * std::exp(0.5 * log_square), static_cast<double>(kMinPhotonRadius));
}
#endif

// Weight of a photon at a squared distance from a visible point, 1 / area: a disc of constant density, 1 when
// integrated over it. The rim belongs to it.
VX_FN float photon_kernel(float distance_squared, float radius) {
    VX_PRECISE float radius_squared = radius * radius;
    return distance_squared <= radius_squared ? kInversePi / radius_squared : 0.0f;
}

// Radius of a pixel after M = `met` more photons: N' = N + alpha M, r'^2 = r^2 N' / (N + M). The flux that
// the paper keeps beside them, tau' = (tau + phi) r'^2 / r^2, is not needed: its density tau / (pi r^2) grows
// in each iteration by that of the new photons, phi / (pi r^2) with the radius before, so the mean of those
// densities is the paper's estimate. Source: Hachisuka and Jensen 2009, "Stochastic Progressive Photon
// Mapping", ACM TOG 28(5), eq. 6 to 9.
VX_FN PixelRadius shrunk_radius(PixelRadius before, float met, float alpha) {
    PixelRadius after = before;
    if (!(met > 0.0f)) return after;
    VX_PRECISE float kept = before.photons + alpha * met;
    VX_PRECISE float all_met = before.photons + met;
    VX_PRECISE float ratio = kept / all_met;
    after.photons = kept;
    after.squared = max(before.squared * ratio, kMinPhotonRadius * kMinPhotonRadius);
    return after;
}

// Probability with which a path of this throughput continues; the throughput is then divided by it. It is the
// largest component, at most 1, rounded up to a multiple of 2^-24, so that `u < survival` has exactly this
// probability for u = unit_float(): roulette is unbiased down to the smallest throughput. 0 for a path
// without throughput. NaN and infinity survive, to be counted as a fault where the path arrives.
VX_FN float roulette_survival(vec3 throughput) {
    float largest = max(max(throughput.x, throughput.y), throughput.z);
    if (largest <= 0.0f) return 0.0f;
    if (!(largest < 1.0f)) return 1.0f;
    float steps = largest * kUnitSteps;
    float whole = floor(steps);
    return (whole < steps ? whole + 1.0f : whole) * kUnitStep;
}

// A photon that leaves a sphere.
struct SphereEmission {
    vec3 normal;     // position: centre + radius * normal
    vec3 direction;  // unit, away from the sphere
};

// Lambertian emission: uniform over the sphere and cosine-weighted about the normal. Each photon of N carries
// radiance * sphere_emission_etendue() / N.
VX_FN SphereEmission sphere_emission(vec2 u_place, vec2 u_direction) {
    SphereEmission emission;
    emission.normal = uniform_cone(vec3(0.0f, 0.0f, 1.0f), 2.0f, u_place);
    emission.direction = cosine_about(emission.normal, u_direction);
    return emission;
}

// Etendue (power / radiance): pi times the area, 4 pi^2 r^2.
VX_FN float sphere_emission_etendue(float radius) {
    return 39.4784176f * radius * radius;
}

// The cone that a sphere subtends.
struct SphereCone {
    vec3 axis;     // unit, towards the centre
    float height;  // 1 - cos of its half angle, in (0, 1); 0 on or inside the sphere: no cone
};

// `to_centre` is the vector to the centre. 1 - cos = sin^2 / (1 + cos) keeps all bits for a tiny light, and 1
// - sin = (d - r) / d for a very near one. Source: Pharr et al., "Physically Based Rendering", 4th edition,
// section 6.2.4.
VX_FN SphereCone sphere_cone(vec3 to_centre, float radius) {
    VX_PRECISE float square = dot(to_centre, to_centre);
    float distance_to = sqrt(square);
    SphereCone cone;
    cone.axis = vec3(0.0f, 0.0f, 1.0f);
    cone.height = 0.0f;
    if (!(distance_to > radius)) return cone;
    VX_PRECISE float sine = radius / distance_to;
    VX_PRECISE float cosine_squared = (distance_to - radius) / distance_to * (1.0f + sine);
    VX_PRECISE float height = sine * sine / (1.0f + sqrt(cosine_squared));
    cone.axis = to_centre / distance_to;
    cone.height = height;
    return cone;
}

// Density per solid angle of uniform_cone(cone.axis, cone.height, u); the height is not 0.
VX_FN float sphere_cone_pdf(SphereCone cone) {
    return 1.0f / cone_solid_angle(cone.height);
}

VX_END

#endif
