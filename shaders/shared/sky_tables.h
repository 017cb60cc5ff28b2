// The texels of the sky's tables: of the light that arrives anywhere in the air (sky_march.h), and of the sky
// as one observer sees it (sky_view.h).
#ifndef VX_SKY_TABLES_H
#define VX_SKY_TABLES_H

#include "sky_march.h"
#include "sky_view.h"

VX_BEGIN

// Directions in which a texel gathers: elevations on either side of the horizon, denser towards it, times
// azimuths on one side of the sun, denser towards it. Products of four Gauss points.
VX_CONST(uint, kScatterRays, 32u);
// A direction in the frame of the harmonics.
struct ScatterRay {
    float cosine;  // to the vertical
    float across;  // towards the sun's side
    float weight;  // steradians that it represents, those on the other side of the sun included
};

VX_FN ScatterRay scatter_ray(float horizon, uint number) {
    const float step = kFourNode[(number >> 2u) & 3u];
    const float turn = kFourNode[number & 3u];
    const bool above = number >= 16u;
    const float range = above ? 0.5f * kPi - horizon : 0.5f * kPi + horizon;
    const float elevation = horizon + (above ? range : -range) * (step * step);
    const float azimuth = kPi * turn * turn;
    const float horizontal = cos(elevation);
    ScatterRay ray;
    ray.cosine = sin(elevation);
    ray.across = horizontal * cos(azimuth);
    ray.weight = (2.0f * range * step * kFourWeight[(number >> 2u) & 3u]) *
                 (4.0f * kPi * turn * kFourWeight[number & 3u]) * horizontal;
    return ray;
}

// The texel at a height and a cosine of the sun: what arrives there according to the current table. In the
// first round there is none, and the light scattered once stands for all orders by the geometric series of
// Hillaire 2020 (equation 10).
VX_FN SkyHarmonics scatter_texel(VX_SKY_PARAM Air air, float h, float sun, bool is_first) {
    SkyHarmonics sum;
    for (uint k = 0u; k < kSkyHarmonics; ++k)
        sum.c[k] = vec3(0.0f);
    if (sun <= kScatterDark) return sum;
    vec3 scatters = vec3(0.0f);
    const float horizontal = sqrt(max(1.0f - sun * sun, 0.0f));
    const float horizon = horizon_elevation(h);
    for (uint number = 0u; number < kScatterRays; ++number) {
        const ScatterRay way = scatter_ray(horizon, number);
        AirRay ray;
        ray.height = h;
        ray.cosine = way.cosine;
        ray.sun = sun;
        ray.sun_angle = clamp(way.cosine * sun + way.across * horizontal, -1.0f, 1.0f);
        const AirLight light = march_air(VX_SKY_ARG air, ray, 1u, !is_first);
        const vec3 radiance = light.rayleigh * rayleigh_phase(ray.sun_angle) +
                              light.mie * mie_phase(air.mie_g, ray.sun_angle) + light.multiple + light.ground;
        const vec3 part = way.weight * radiance;
        const float z2 = way.cosine * way.cosine;
        sum.c[0] += part;
        sum.c[1] += part * way.cosine;
        sum.c[2] += part * way.across;
        sum.c[3] += part * (1.5f * z2 - 0.5f);
        sum.c[4] += part * (way.cosine * way.across);
        sum.c[5] += part * (2.0f * way.across * way.across - (1.0f - z2));
        scatters += way.weight * light.scatters;
    }
    // Inverse of the integrals of the squared harmonics.
    const float norm = 0.25f * kInversePi;
    sum.c[0] *= norm;
    sum.c[1] *= 3.0f * norm;
    sum.c[2] *= 3.0f * norm;
    sum.c[3] *= 5.0f * norm;
    sum.c[4] *= 15.0f * norm;
    sum.c[5] *= 3.75f * norm;
    if (is_first) sum.c[0] = sum.c[0] / (vec3(1.0f) - min(norm * scatters, vec3(0.9f)));
    return sum;
}

// A pair of harmonics as the table keeps it.
VX_FN uvec4 scatter_pair(SkyHarmonics texel, uint pair) {
    const vec3 a = kScatterScale * texel.c[2u * pair];
    const vec3 b = kScatterScale * texel.c[2u * pair + 1u];
    return uvec4(packHalf2x16(vec2(a.x, a.y)), packHalf2x16(vec2(a.z, b.x)), packHalf2x16(vec2(b.y, b.z)),
                 0u);
}

struct ViewTexel {
    vec3 light;  // without what aerosol scattered once
    vec3 mie;    // that, divided by its phase function
};

VX_FN ViewTexel view_texel(VX_SKY_PARAM SkyParams sky, uint row, uint column) {
    const float elevation = view_elevation(sky, row);
    const float sun_horizontal = sqrt(max(1.0f - sky.sun_direction.z * sky.sun_direction.z, 0.0f));
    AirRay ray;
    ray.height = sky.height;
    ray.cosine = sin(elevation);
    ray.sun = sky.sun_direction.z;
    ray.sun_angle = clamp(
        ray.cosine * ray.sun + cos(elevation) * cos(view_azimuth(sky, column)) * sun_horizontal, -1.0f, 1.0f);
    ViewTexel texel;
    texel.light = texel.mie = vec3(0.0f);
    const float way = distance_to_air(ray.height, ray.cosine);
    if (way < 0.0f) return texel;
    const AirLight light = march_air(VX_SKY_ARG sky.air, ray_after(ray, way), kViewPanels, true);
    texel.light = light.rayleigh * rayleigh_phase(ray.sun_angle) + light.multiple + light.ground;
    texel.mie = light.mie;
    return texel;
}

VX_END

#endif
