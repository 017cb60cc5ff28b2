#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// Shades the camera rays of a sample and adds what they saw to the exact sums of the film, as far as the plan
// has them.

#include "lib/address.glsl"

#include "lib/invocation.glsl"

#include "lib/counters_access.glsl"
#include "lib/film_group.glsl"
#include "lib/film_sums.glsl"

VX_SPECIALIZED(uint, has_specular, 1u);  // first hits differ from the shaded ones
VX_SPECIALIZED(uint, sums_squares, 1u);
VX_SPECIALIZED(uint, sums_bias, 1u);
VX_SPECIALIZED(uint, sums_coverage, 0u);  // there is a background: misses are transparent
VX_SPECIALIZED(uint, sums_surface, 1u);
VX_SPECIALIZED(uint, sums_ao, 1u);
VX_SPECIALIZED(uint, sums_sun, 1u);
VX_SPECIALIZED(uint, keeps_color, 1u);

layout(rgba32ui) readonly uniform uimageBuffer FirstHits;  // before mirrors and glass
layout(rgba32ui) readonly uniform uimageBuffer HalfAreaPhotons;
VX_SUMS(Beauty);
VX_SUMS(Squares);
VX_SUMS(Bias);
VX_SUMS(Coverage);
VX_SUMS(Albedo);
VX_SUMS(Normal);
VX_SUMS(AoSums);
VX_SUMS(SunSums);
layout(rgba32ui) writeonly uniform uimageBuffer Color;
layout(push_constant, scalar) uniform Push {
    FilmAddPush push;
};

#include "lib/film_cover.glsl"

void add_beauty(uint at, uint film_group, Group group) {
    vec3 color[kGroupPixels];
    uint hits = 0u;
    for (uint k = 0u; k < kGroupPixels; ++k) {
        color[k] = group.inside[k] ? radiance(group, k) : vec3(0.0);
        hits += is_surface(group.hits[k]) ? 1u : 0u;
    }
    count(kWorkHits, hits);
    if (sums_coverage != 0u) {
        vec4 coverage = cover(at, group, color);
        VX_ADD_FLOATS(Coverage, film_group, add_pair, coverage);
    }
    VX_ADD_VECTORS(Beauty, film_group, add_pair, color);
    if (sums_squares != 0u) {
        VX_ADD_VECTORS(Squares, film_group, add_squares, color);
    }
    if (keeps_color != 0u) {
        VX_STORE_VECTORS(Color, at, color);
    }
}

// The bias that the smoothing by kernels adds to the light of photons, as radiance. To first order it is
// proportional to the area of the kernel, and the half-area kernel has half of it: so it is twice the
// difference. Each estimate is noisy; their mean converges. Source: Hachisuka, Jarosz and Jensen 2010, "A
// Progressive Error Estimation Framework for Photon Density Estimation", for the idea; the second radius
// replaces their derivatives of the kernel.
void add_bias(uint film_group, Group group, vec3 half_area_light[kGroupPixels]) {
    vec3 off[kGroupPixels];
    for (uint k = 0u; k < kGroupPixels; ++k) {
        vec3 reflected = group.weights[k] * group.albedo[k] * kInversePi;
        vec3 bias = 2.0 * reflected * (group.photons[k] - half_area_light[k]);
        off[k] = is_surface(group.hits[k]) ? bias : vec3(0.0);
    }
    VX_ADD_VECTORS(Bias, film_group, add_pair, off);
}

// Albedo and normal of the first hits of camera rays; zero for misses.
void add_surface(uint film_group, Group group) {
    vec3 albedo[kGroupPixels];
    vec3 normal[kGroupPixels];
    for (uint k = 0u; k < kGroupPixels; ++k) {
        bool has_normal = is_surface(group.hits[k]) && group.hits[k].face != kFaceInside;
        albedo[k] = is_surface(group.hits[k]) ? group.albedo[k] : vec3(0.0);
        normal[k] = has_normal ? surface_normal(group.hits[k]) : vec3(0.0);
    }
    VX_ADD_VECTORS(Albedo, film_group, add_pair, albedo);
    VX_ADD_VECTORS(Normal, film_group, add_pair, normal);
}

void main() {
    uint at = linear_id();
    uint skipped = push.first_pixel % kGroupPixels;
    if (kGroupPixels * at >= skipped + push.pixel_count) return;
    uint film_group = push.first_pixel / kGroupPixels + at;
    Group group = load_group(at, skipped, skipped + push.pixel_count);
    add_beauty(at, film_group, group);
    if (sums_bias != 0u) {
        vec3 half_area_light[kGroupPixels] = VX_GROUP_VECTORS(HalfAreaPhotons, at, 1u);
        add_bias(film_group, group, half_area_light);
    }
    bvec4 inside = bvec4(group.inside[0], group.inside[1], group.inside[2], group.inside[3]);
    if (sums_ao != 0u) {
        VX_ADD_FLOATS(AoSums, film_group, add_pair, mix(vec4(0.0), group.ao, inside));
    }
    if (sums_sun != 0u) {
        VX_ADD_FLOATS(SunSums, film_group, add_pair, mix(vec4(0.0), group.sun, inside));
    }
    if (sums_surface != 0u) {
        if (has_specular != 0u) {
            Hit first_hits[kGroupPixels] = VX_GROUP_HITS(FirstHits, at, 1u);
            set_hits(group, first_hits);
        }
        add_surface(film_group, group);
    }
    count(kFaultFilmClamped, clamped);
    count(kFaultFilmNonFinite, non_finite);
}
