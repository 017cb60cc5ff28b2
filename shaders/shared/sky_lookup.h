// The radiance of the sky from its table (sky_view.h), and the sun's disc. The including file defines
// VX_VIEW_PARAM and VX_VIEW_ARG and load_view(), which reads a colour of the table.
#ifndef VX_SKY_LOOKUP_H
#define VX_SKY_LOOKUP_H

#include "sky_view.h"

VX_BEGIN

// The sum of a pair of products in a fixed order, so that quarter turns about the vertical give the same
// bits.
VX_FN float product_sum(float a, float b, float c, float d) {
    VX_PRECISE float first = a * b;
    VX_PRECISE float second = c * d;
    VX_PRECISE float sum = first + second;
    return sum;
}

VX_FN vec3 view_blend(VX_VIEW_PARAM ViewPlace place, uint columns, uint colour) {
    const uint i = min(uint(place.row), place.rows - 2u);
    const uint j = min(uint(place.column), columns - 2u);
    const uint texel = kViewColours * ((place.first_row + i) * columns + j) + colour;
    const uint below = texel + kViewColours * columns;
    const float v = place.row - float(i);
    const float w = place.column - float(j);
    return mix(mix(load_view(VX_VIEW_ARG texel), load_view(VX_VIEW_ARG texel + kViewColours), w),
               mix(load_view(VX_VIEW_ARG below), load_view(VX_VIEW_ARG below + kViewColours), w), v);
}

// Radiance from a unit direction, including the ground but not the sun's disc.
VX_FN vec3 sky_radiance(VX_VIEW_PARAM SkyParams sky, vec3 direction) {
    const vec3 sun = sky.sun_direction;
    const float horizontal2 = product_sum(direction.x, direction.x, direction.y, direction.y);
    const float elevation = atan(direction.z, sqrt(horizontal2));
    const float along = product_sum(direction.x, sun.x, direction.y, sun.y);
    const float across = abs(product_sum(direction.x, sun.y, -direction.y, sun.x));
    const bool has_azimuth = along != 0.0f || across != 0.0f;
    const float azimuth = has_azimuth ? atan(across, along) : 0.0f;
    VX_PRECISE float sun_angle = along + direction.z * sun.z;
    const ViewPlace place = view_place(sky, elevation, azimuth, hits_ground(sky.height, direction.z));
    const uint columns = view_columns(sky.resolution);
    const vec3 light = view_blend(VX_VIEW_ARG place, columns, 0u) +
                       mie_phase(sky.air.mie_g, sun_angle) * view_blend(VX_VIEW_ARG place, columns, 1u);
    return elevation > sky.top ? vec3(0.0f) : light * sky.irradiance;
}

// Radiance of the sun's disc in a direction, dimmed by the air. Limb darkening mu^a: Hestroffer and Magnan
// 1998, with the exponents of Hillaire 2016, "Physically Based Sky, Atmosphere and Cloud Rendering in
// Frostbite"; the factor (a + 2) / 2 keeps the irradiance.
VX_FN vec3 sun_disc_radiance(SkyParams sky, vec3 direction) {
    const vec3 away = direction - sky.sun_direction;
    const float part =
        0.5f * dot(away, away) / max(sky.disc_height, 1e-12f);  // squared sine relative to the radius'
    if (sky.disc_height <= 0.0f || part >= 1.0f) return vec3(0.0f);
    const vec3 darkening = vec3(0.397f, 0.503f, 0.652f);
    const vec3 limb = pow(vec3(sqrt(1.0f - part)), darkening) * (0.5f * darkening + vec3(1.0f));
    return sky.irradiance * limb * transmittance_out(sky.air, sky.height, direction.z) *
           (0.5f * kInversePi / sky.disc_height);
}

VX_END

#endif
