// Rough metal and rough glass: a surface of many small mirrors or panes (microfacets) whose normals have the
// GGX distribution (Trowbridge and Reitz 1975, "Average Irregularity Representation of a Rough Surface";
// Walter et al. 2007, "Microfacet Models for Refraction through Rough Surfaces"). Masking is Smith's:
// height-correlated in reflection (Heitz 2014, "Understanding the Masking-Shadowing Function in
// Microfacet-Based BRDFs", eq. 99), the product of both sides in refraction (Walter, eq. 23). Visible normals
// are sampled as spherical caps (Heitz 2018, "Sampling the GGX Distribution of Visible Normals"; Dupuy and
// Benyoub 2023, "Sampling Visible GGX Normals with Spherical Caps").
//
// One scattering loses the light that a second microfacet would have sent on. Gains make up for it. Those of
// glass are Turquin's (2019, "Practical multiple scattering compensation for microfacet models"): 1 / E,
// where E(cos_out) is what one scattering keeps. This is not reciprocal, as one scattering is. Metal
// therefore takes gain(cos_out) * gain(cos_in), with the one function by which a white surface keeps all
// light: symmetric, like the scattering itself (Sinkhorn 1967, "Diagonal Equivalence to Matrices with
// Prescribed Row and Column Sums"). For glass that would be far from 1, since both of its sides depend on
// each other. passes/specular/rough_gains.cpp computes both.
//
// Cosines are to the normal on the side that the path comes from. `eta` is n_far / n_near of glass, 0 of
// metal.
#ifndef VX_BSDF_H
#define VX_BSDF_H

#include "dielectric.h"
#include "limits.h"
#include "portable.h"
#include "sampling.h"

VX_BEGIN

// Roughness of the distribution for a material's roughness in [0, 1]; 0 below kMinRoughness: a smooth
// surface.
VX_FN float rough_alpha(float roughness) {
    return roughness >= kMinRoughness ? min(roughness * roughness, 1.0f) : 0.0f;
}

// Whether a surface scatters: not where glass bends light by less than float directions can tell.
VX_FN bool is_rough(float alpha, float eta) {
    return alpha > 0.0f && (eta == 0.0f || alpha * abs(eta - 1.0f) >= kMinSpread);
}

// sqrt(cos^2 + alpha^2 sin^2): 1 + Lambda of Smith is (1 + smith_root(c) / c) / 2.
VX_FN float smith_root(float cosine, float alpha) {
    float square = cosine * cosine;
    return sqrt(square + alpha * alpha * max(1.0f - square, 0.0f));
}

// GGX density of a microfacet's unit normal per solid angle of the surface's normal. The tangent comes from
// the cross product, because 1 - cos^2 of a nearly smooth surface has no bits left.
VX_FN float facet_density(vec3 facet, vec3 normal, float alpha) {
    float cosine = dot(facet, normal);
    vec3 along = cross(facet, normal);
    float square = alpha * alpha;
    float spread = dot(along, along) + square * cosine * cosine;
    return cosine > 0.0f ? square / (kPi * spread * spread) : 0.0f;
}

// A microfacet's normal as seen from the unit direction `outward`, on the side of `normal`.
VX_FN vec3 sample_facet(vec3 outward, vec3 normal, float alpha, vec2 u) {
    Basis basis = basis_around(normal);
    vec3 local =
        vec3(dot(outward, basis.tangent), dot(outward, basis.bitangent), max(dot(outward, normal), 0.0f));
    vec3 stretched = normalize(vec3(alpha * local.x, alpha * local.y, local.z));
    vec3 cap = uniform_cone(vec3(0.0f, 0.0f, 1.0f), 1.0f + stretched.z, u);
    vec3 middle = cap + stretched;
    vec3 facet = vec3(alpha * middle.x, alpha * middle.y, max(middle.z, 0.0f));
    float length2 = dot(facet, facet);
    return length2 > 0.0f ? from_basis(basis, facet / sqrt(length2)) : normal;
}

// G2 / G1: the part of what a microfacet sends that the others let out. `cos_in` is that to the normal on the
// side of this direction.
VX_FN float unmasked(float cos_out, float cos_in, float alpha) {
    float root_out = smith_root(cos_out, alpha);
    return cos_in * (cos_out + root_out) / (root_out * cos_in + smith_root(cos_in, alpha) * cos_out);
}

// What a direction is worth after the direction `outward`.
struct RoughValue {
    float pdf;     // with which it is sampled, per solid angle
    float weight;  // value times cosine / pdf, without gains and without the factor of refraction on radiance
    bool crosses;  // the surface: it is refracted
};

// Both directions are unit and point away from the surface. Directions into which nothing is sent have pdf 0.
VX_FN RoughValue evaluate_rough(vec3 outward, vec3 inward, vec3 normal, float alpha, float eta) {
    RoughValue value;
    value.pdf = 0.0f;
    value.weight = 0.0f;
    float cos_out = dot(outward, normal);
    float cos_in = dot(inward, normal);
    value.crosses = cos_in < 0.0f;
    if (!(cos_out > 0.0f) || cos_in == 0.0f || (value.crosses && eta == 0.0f)) return value;
    vec3 sum = value.crosses ? -(outward + eta * inward) : outward + inward;
    if (value.crosses && eta < 1.0f) sum = -sum;
    float length2 = dot(sum, sum);
    if (!(length2 > 0.0f)) return value;
    vec3 facet = sum / sqrt(length2);
    float facet_out = dot(outward, facet);
    float facet_in = dot(inward, facet);
    if (!(facet_out > 0.0f) || (facet_in < 0.0f) != value.crosses) return value;
    // Density of visible normals, over facet_out: G1 D / cos_out.
    float seen = 2.0f * facet_density(facet, normal, alpha) / (cos_out + smith_root(cos_out, alpha));
    float reflected = eta == 0.0f ? 1.0f : dielectric(facet_out, eta).reflectance;
    float refracted = (1.0f - reflected) * facet_out * eta * eta * -facet_in / length2;
    value.pdf = seen * (value.crosses ? refracted : 0.25f * reflected);
    value.weight = unmasked(cos_out, abs(cos_in), alpha);
    return value;
}

// A direction with the pdf of evaluate_rough(), or zero where the surface itself is in the way of what a
// microfacet sends: then nothing is sent. The first two numbers choose the microfacet, the third reflection
// or refraction.
VX_FN vec3 sample_rough(vec3 outward, vec3 normal, float alpha, float eta, vec3 u) {
    vec3 facet = sample_facet(outward, normal, alpha, vec2(u.x, u.y));
    vec3 inward = mirror_direction(-outward, facet);
    bool is_open = dot(inward, normal) > 0.0f;
    if (eta != 0.0f) {
        Dielectric surface = dielectric(dot(outward, facet), eta);
        if (!surface.is_total && u.z >= surface.reflectance) {
            inward = refracted_direction(-outward, facet, eta, surface);
            is_open = dot(inward, normal) < 0.0f;
        }
    }
    return is_open ? inward : vec3(0.0f);
}

// Where on a row of gains a cosine is, in [0, 1]. Near the horizon, where gains change within some alpha,
// places are denser.
VX_FN float gain_place(float cosine, float alpha) {
    float c = clamp(cosine, 0.0f, 1.0f);
    float scale = min(alpha, kGainScale);
    return c * (1.0f + scale) / (c + scale);
}

// Its inverse.
VX_FN float gain_cosine(float place, float alpha) {
    float scale = min(alpha, kGainScale);
    return place * scale / (1.0f + scale - place);
}

// The factor of a metal's value. `gains` is gain(cos_out) * gain(cos_in). Light scattered more than once has
// met the albedo more than once: a white surface keeps all light, and one of albedo a keeps a E + a^2 (1 - E)
// of it, where E is kept by one scattering (Turquin 2019, eq. 16).
VX_FN vec3 metal_factor(vec3 albedo, float gains) {
    return vec3(1.0f) + albedo * (gains - 1.0f);
}

VX_END

#endif
