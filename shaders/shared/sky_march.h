// The light that the air scatters along a ray, all orders of scattering included.
//
// The first order is integrated along the ray with exact phase functions. The others come from a table of the
// light that arrives at a place from all directions, in spherical harmonics of degree 0 to 2 (6 numbers per
// colour, as the light is symmetric about the vertical plane of the sun), by height and by the sun's cosine.
// Scattering multiplies each degree by a moment of its phase function. The table is the fixed point of its
// own definition: gathered from rays that march through it (scatter_texel), in a few rounds. Hillaire 2020
// keeps only the mean over directions and closes the orders by a geometric series, which ignores the
// direction of the light of later orders and its variation from place to place. This method removes most of
// that error, in particular at the horizon and in twilight, at the same cost. (Discrete ordinates with
// delta-free moments: Chandrasekhar 1960, "Radiative Transfer", section 48.)
//
// All light is per unit of the sun's irradiance above the air. The including file defines VX_SKY_PARAM and
// VX_SKY_ARG and load_scatter(), which reads a word of the table.
#ifndef VX_SKY_MARCH_H
#define VX_SKY_MARCH_H

#include "air_ray.h"
#include "sky_view.h"

VX_BEGIN

// The sun's cosines are densest around the middle one, at sunset, and end where even the top of the air is
// dark.
VX_CONST(float, kScatterMiddle, -0.06f);
VX_CONST(float, kScatterWidth, 0.25f);
VX_CONST(float, kScatterFirst, -0.489795918f);  // (-0.3 - middle) / (|-0.3 - middle| + width)
VX_CONST(float, kScatterLast, 0.809160305f);    // of cosine 1
// The sun's cosine at or below which there is no light: that of the first column.
VX_CONST(float, kScatterDark, -0.2999f);
// Nodes of a section of a ray: 6 Gauss points per panel.
VX_CONST(uint, kGaussNodes, 6u);
VX_CONST_LIST(float, kGaussNode, 6) = {0.0337652429f, 0.1693953068f, 0.3806904070f,
                                       0.6193095930f, 0.8306046932f, 0.9662347571f};
VX_CONST_LIST(float, kGaussWeight, 6) = {0.0856622462f, 0.1803807865f, 0.2339569673f,
                                         0.2339569673f, 0.1803807865f, 0.0856622462f};

struct AirLight {
    vec3 rayleigh;  // scattered once, by air, divided by its phase function
    vec3 mie;       // scattered once, by aerosol, divided by its phase function
    vec3 multiple;  // scattered more than once
    vec3 ground;    // from the ground, attenuated along the ray
    vec3 scatters;  // fraction that scattering would add to light that is the same all along the ray
};

struct SkyHarmonics {
    vec3 c[6];
};

VX_FN float scatter_height(uint row) {
    const float v = float(row) / float(kScatterHeights - 1u);
    return kScatterTop * v * v;
}

VX_FN float scatter_cosine(uint column) {
    const float u =
        kScatterFirst + (kScatterLast - kScatterFirst) * (float(column) / float(kScatterCosines - 1u));
    return min(kScatterMiddle + kScatterWidth * u / (1.0f - abs(u)), 1.0f);
}

VX_FN SkyHarmonics scatter_entry(VX_SKY_PARAM uint texel, float weight) {
    SkyHarmonics entry;
    for (uint pair = 0u; pair < kTexelPairs; ++pair) {
        const uvec4 words = load_scatter(VX_SKY_ARG kTexelPairs * texel + pair);
        const vec2 a = unpackHalf2x16(words.x);
        const vec2 b = unpackHalf2x16(words.y);
        const vec2 c = unpackHalf2x16(words.z);
        entry.c[2u * pair] = weight * vec3(a.x, a.y, b.x);
        entry.c[2u * pair + 1u] = weight * vec3(b.y, c.x, c.y);
    }
    return entry;
}

// The light that arrives at a height when the sun has a cosine, as the coefficients of the harmonics.
// Interpolated linearly on the triangles of the table: a march spends most of its time on loads, and a
// triangle has only three corners.
VX_FN SkyHarmonics scatter_lookup(VX_SKY_PARAM float h, float sun) {
    const float row = sqrt(clamp(h / kScatterTop, 0.0f, 1.0f)) * float(kScatterHeights - 1u);
    const float away = sun - kScatterMiddle;
    const float u = (away / (abs(away) + kScatterWidth) - kScatterFirst) / (kScatterLast - kScatterFirst);
    const float column = clamp(u, 0.0f, 1.0f) * float(kScatterCosines - 1u);
    const uint i = min(uint(row), kScatterHeights - 2u);
    const uint j = min(uint(column), kScatterCosines - 2u);
    const float v = row - float(i);
    const float w = column - float(j);
    const bool is_low = v + w <= 1.0f;
    const uint texel = i * kScatterCosines + j;
    const float unit = 1.0f / kScatterScale;
    SkyHarmonics found =
        scatter_entry(VX_SKY_ARG is_low ? texel : texel + kScatterCosines + 1u, unit * abs(1.0f - v - w));
    const SkyHarmonics next = scatter_entry(VX_SKY_ARG texel + 1u, unit * (is_low ? w : 1.0f - v));
    const SkyHarmonics above =
        scatter_entry(VX_SKY_ARG texel + kScatterCosines, unit * (is_low ? v : 1.0f - w));
    for (uint k = 0u; k < kSkyHarmonics; ++k)
        found.c[k] += next.c[k] + above.c[k];
    return found;
}

// The light scattered into a direction: `cosine` to the vertical, `across` its x in the harmonics' frame.
// zeroth, first, second: scattering coefficients times the moments of the phase function.
VX_FN vec3 scattered_light(SkyHarmonics light, float cosine, float across, vec3 zeroth, vec3 first,
                           vec3 second) {
    const float z2 = cosine * cosine;
    const float difference = 2.0f * across * across - max(1.0f - z2, 0.0f);  // x^2 - y^2
    return zeroth * light.c[0] + first * (light.c[1] * cosine + light.c[2] * across) +
           second *
               (light.c[3] * (1.5f * z2 - 0.5f) + light.c[4] * (cosine * across) + light.c[5] * difference);
}

// Irradiance of the ground from the harmonics of the light there.
VX_FN vec3 diffuse_irradiance(SkyHarmonics light) {
    return max(kPi * light.c[0] + (2.0f / 3.0f * kPi) * light.c[1] + (0.25f * kPi) * light.c[3], vec3(0.0f));
}

// Radiance of the ground where the sun has this cosine.
VX_FN vec3 ground_radiance(VX_SKY_PARAM Air air, float sun, bool has_table) {
    vec3 irradiance = max(sun, 0.0f) * transmittance_out(air, 0.0f, sun);
    if (has_table) irradiance += diffuse_irradiance(scatter_lookup(VX_SKY_ARG 0.0f, sun));
    return (air.ground_albedo * kInversePi) * irradiance;
}

// Where a ray is split, in increasing order: at its lowest point and where it enters and leaves the planet's
// shadow, the half cylinder of the ground's radius behind the centre. Its light has kinks there. 0: no split.
VX_FN vec3 air_cuts(AirRay ray, float end) {
    const float r = kGroundRadius + ray.height;
    const float lowest = -r * ray.cosine;
    const float a = 1.0f - ray.sun_angle * ray.sun_angle;
    const float b = r * (ray.cosine - ray.sun * ray.sun_angle);
    const float c = ray.height * (2.0f * kGroundRadius + ray.height) - r * r * ray.sun * ray.sun;
    const float square = b * b - a * c;
    const float root = sqrt(max(square, 0.0f));
    const bool crosses = square > 0.0f && a > 1e-6f;
    float into = crosses ? (-b - root) / a : 0.0f;
    float out_of = crosses ? (-b + root) / a : 0.0f;
    if (into >= end || r * ray.sun + into * ray.sun_angle > 0.0f) into = 0.0f;
    if (out_of >= end || r * ray.sun + out_of * ray.sun_angle > 0.0f) out_of = 0.0f;
    const float turn = lowest < end ? max(lowest, 0.0f) : 0.0f;
    into = max(into, 0.0f);
    out_of = max(out_of, into);
    return vec3(min(turn, into), max(min(turn, out_of), into), max(turn, out_of));
}

// Node `number` of a stretch of the ray.
VX_FN AirNode gauss_node(uint number, uint panels, bool rises) {
    const uint panel = number / kGaussNodes;
    const uint place = number - panel * kGaussNodes;
    return air_node((float(panel) + kGaussNode[place]) / float(panels), kGaussWeight[place] / float(panels),
                    rises);
}

VX_FN AirLight no_light() {
    AirLight light;
    light.rayleigh = light.mie = light.multiple = light.ground = light.scatters = vec3(0.0f);
    return light;
}

// Adds what a place on the way scatters, which stands for `length` of it. moments: mie_moments.
VX_FN AirLight gather(VX_SKY_PARAM Air air, AirRay ray, AirWay way, float t, float length, vec3 moments,
                      bool has_table, AirLight light) {
    const float r = kGroundRadius + ray.height;
    const float height = height_after(ray.height, ray.cosine, t);
    const float cosine = clamp((r * ray.cosine + t) / (kGroundRadius + height), -1.0f, 1.0f);
    const float sun = clamp((r * ray.sun + t * ray.sun_angle) / (kGroundRadius + height), -1.0f, 1.0f);
    const vec3 reaches = length * passes_from(air, ray, way, t, height, cosine);
    const vec3 density = air_densities(height);
    const vec3 rayleigh = air.rayleigh * density.x;
    const float aerosol = air.mie * density.y;
    const vec3 sunlight = reaches * transmittance_out(air, height, sun);
    light.rayleigh += sunlight * rayleigh;
    light.mie += sunlight * aerosol;
    light.scatters += reaches * (rayleigh + vec3(aerosol));
    if (!has_table) return light;
    const float horizontal = sqrt(max(1.0f - sun * sun, 1e-8f));
    light.multiple +=
        reaches * scattered_light(scatter_lookup(VX_SKY_ARG height, sun), cosine,
                                  (ray.sun_angle - cosine * sun) / horizontal, rayleigh + vec3(aerosol),
                                  vec3(aerosol * moments.y), 0.1f * rayleigh + vec3(aerosol * moments.z));
    return light;
}

// The march. `panels` sets the number of nodes. Without a table only the sun lights air and ground.
VX_FN AirLight march_air(VX_SKY_PARAM Air air, AirRay ray, uint panels, bool has_table) {
    const AirWay way = way_of(ray);
    const vec3 cuts = air_cuts(ray, way.end);
    const vec3 moments = mie_moments(air.mie_g);
    const float lowest = -(kGroundRadius + ray.height) * ray.cosine;
    AirLight light = no_light();
    float to = 0.0f;
    for (uint stretch = 0u; stretch < 4u; ++stretch) {
        const float from = to;
        to = stretch == 0u ? cuts.x : (stretch == 1u ? cuts.y : (stretch == 2u ? cuts.z : way.end));
        if (to <= from) continue;
        const bool rises = from >= lowest;
        for (uint node = 0u; node < kGaussNodes * panels; ++node) {
            const AirNode at = gauss_node(node, panels, rises);
            light = gather(VX_SKY_ARG air, ray, way, from + (to - from) * at.way, (to - from) * at.weight,
                           moments, has_table, light);
        }
    }
    if (way.is_ground) {
        const AirRay there = ray_to_ground(ray, way);
        light.ground = passes_from(air, ray, way, way.end, 0.0f, there.cosine) *
                       ground_radiance(VX_SKY_ARG air, there.sun, has_table);
    }
    light.multiple = max(light.multiple, vec3(0.0f));
    return light;
}

VX_END

#endif
