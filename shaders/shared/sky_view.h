// The sky as one observer sees it under one sun: its parameters, and its table. Rows are elevations, denser
// towards the horizon, first those above it, then those below; columns are azimuths from the sun, on one side
// of it. (Hillaire 2020, section 5.3, takes sin(azimuth / 2).) What aerosol has scattered once has a texel of
// its own, without the phase function: the glow around the sun is then not limited by the table, and the rest
// needs few texels.
#ifndef VX_SKY_VIEW_H
#define VX_SKY_VIEW_H

#include "air_ray.h"

VX_BEGIN

struct SkyParams {
    Air air;
    float height;        // of the observer above the ground, km
    float horizon;       // its elevation, radians
    float top;           // elevation of the highest ray that meets air, radians
    float disc_height;   // cone_height of the sun's angular radius; 0: its disc is not seen
    vec3 sun_direction;  // unit
    vec3 irradiance;     // of a surface above the air that faces the sun
    uint resolution;     // rows above the horizon; half as many below, and half as many columns
    float km_per_voxel;
};

// The table of the light that arrives anywhere in the air (sky_march.h).
// Harmonics of a direction (x, y, z), z up and the sun over the x axis: 1, z, x, (3 z^2 - 1) / 2, z x, x^2 -
// y^2.
VX_CONST(uint, kSkyHarmonics, 6u);
VX_CONST(uint, kScatterHeights, 6u);   // of the table, from the ground up
VX_CONST(float, kScatterTop, 50.0f);   // km; above, too little air is left to scatter what arrives
VX_CONST(uint, kScatterCosines, 24u);  // of the sun
VX_CONST(uint, kScatterTexels, kScatterHeights* kScatterCosines);
// Two harmonics are six half floats: three words of four, which lavapipe loads at once.
VX_CONST(uint, kTexelPairs, kSkyHarmonics / 2u);
VX_CONST(uint, kScatterPairs, kScatterTexels* kTexelPairs);
// Numbers are kept multiplied by this: half floats lose bits below 6e-5, and the sky of deep dusk is darker.
VX_CONST(float, kScatterScale, 1024.0f);
// Rounds after the first. A round multiplies the missing light by the fraction that scatters again, a third
// in blue.
VX_CONST(uint, kScatterRounds, 2u);

// Panels of a march (sky_march.h): with these, order 1 in the table of the sky has an error of 0.1 % (RMS
// over our oracle); with the fine ones it is within 1 % in every direction.
VX_CONST(uint, kViewPanels, 2u);
VX_CONST(uint, kFinePanels, 4u);

// Push constants of sky_scatter.
struct SkyScatterPush {
    Air air;
    uint is_first;  // round
};

VX_FN uint view_columns(uint resolution) {
    return resolution / 2u;
}
VX_FN uint view_texels(uint resolution) {
    return (resolution + resolution / 2u) * view_columns(resolution);
}
// A texel has two colours: the light without what aerosol scattered once, and that divided by its phase
// function.
VX_CONST(uint, kViewColours, 2u);

// Distance in radians of the rows next to the horizon from it.
VX_CONST(float, kHorizonGap, 1e-6f);

// Distance at which rays from an observer enter the air: 0 inside it, negative where they miss it.
VX_FN float distance_to_air(float h, float cosine) {
    if (h <= kAirTop) return 0.0f;
    const float b = (kGroundRadius + h) * cosine;
    const float c = (h - kAirTop) * (2.0f * kGroundRadius + h + kAirTop);
    const float square = b * b - c;
    return b < 0.0f && square >= 0.0f ? c / (sqrt(square) - b) : -1.0f;
}

VX_FN AirRay air_ray_of(SkyParams sky, vec3 direction) {
    AirRay ray;
    ray.height = sky.height;
    ray.cosine = clamp(direction.z, -1.0f, 1.0f);
    ray.sun = sky.sun_direction.z;
    ray.sun_angle = clamp(dot(direction, sky.sun_direction), -1.0f, 1.0f);
    return ray;
}

// Position in a table with texels at both ends.
struct ViewPlace {
    float row;
    float column;
    uint first_row;  // of the half that the ray is in
    uint rows;       // of that half
};

// Elevation and azimuth from the sun in radians, azimuth in [0, pi].
VX_FN ViewPlace view_place(SkyParams sky, float elevation, float azimuth, bool is_ground) {
    ViewPlace place;
    place.rows = is_ground ? sky.resolution / 2u : sky.resolution;
    place.first_row = is_ground ? sky.resolution : 0u;
    const float range = is_ground ? 0.5f * kPi + sky.horizon : sky.top - sky.horizon;
    const float away = is_ground ? sky.horizon - elevation : elevation - sky.horizon;
    place.row = sqrt(clamp(away / max(range, kHorizonGap), 0.0f, 1.0f)) * float(place.rows - 1u);
    place.column = clamp(azimuth * kInversePi, 0.0f, 1.0f) * float(view_columns(sky.resolution) - 1u);
    return place;
}

// The elevation of a row of the table: the inverse of view_place.
VX_FN float view_elevation(SkyParams sky, uint row) {
    const bool is_ground = row >= sky.resolution;
    const uint rows = is_ground ? sky.resolution / 2u : sky.resolution;
    const float v = float(is_ground ? row - sky.resolution : row) / float(rows - 1u);
    if (is_ground) return sky.horizon - max((0.5f * kPi + sky.horizon) * v * v, kHorizonGap);
    return sky.horizon + max((sky.top - sky.horizon) * v * v, kHorizonGap);
}

VX_FN float view_azimuth(SkyParams sky, uint column) {
    return kPi * (float(column) / float(view_columns(sky.resolution) - 1u));
}

// Directions over which the irradiance of a surface is summed: elevations on either side of the horizon,
// denser towards it, times azimuths all round. Midpoints.
VX_CONST(uint, kFaceElevations, 24u);  // on a side
VX_CONST(uint, kFaceAzimuths, 32u);
VX_CONST(uint, kFaceRays, 2u * kFaceElevations * kFaceAzimuths);

struct FaceRay {
    vec3 direction;
    float weight;  // steradians
};

VX_FN FaceRay face_ray(SkyParams sky, uint number) {
    const uint ring = number / kFaceAzimuths;
    const bool above = ring >= kFaceElevations;
    const float u = (float(ring % kFaceElevations) + 0.5f) / float(kFaceElevations);
    const float range = 0.5f * kPi + (above ? -sky.horizon : sky.horizon);
    const float elevation = sky.horizon + (above ? range : -range) * (u * u);
    const float azimuth = 2.0f * kPi * ((float(number % kFaceAzimuths) + 0.5f) / float(kFaceAzimuths));
    const float horizontal = cos(elevation);
    FaceRay ray;
    ray.direction = vec3(horizontal * cos(azimuth), horizontal * sin(azimuth), sin(elevation));
    ray.weight = 2.0f * range * u / float(kFaceElevations) * (2.0f * kPi / float(kFaceAzimuths)) * horizontal;
    return ray;
}

VX_END

#endif
