// Sums of photons at a visible point, and the irradiance that follows from them. Include lib/address.glsl and
// lib/photon_frame.glsl first.
#ifndef VX_PHOTON_LIGHT_GLSL
#define VX_PHOTON_LIGHT_GLSL

#include "shared/photon_cell.h"
#include "shared/photon_power.h"

layout(scalar) writeonly buffer Light {
    vec3 light[];
};
layout(scalar) writeonly buffer HalfAreaLight {
    vec3 half_area_light[];
};

// In quanta.
struct PhotonSums {
    uint met;        // photons within the radius, where pixels have their own
    u64vec3 wide;    // within the radius
    u64vec3 half_area;  // within the half-area radius
};

PhotonSums no_photons() {
    PhotonSums sums;
    sums.met = 0u;
    sums.wide = u64vec3(0u);
    sums.half_area = u64vec3(0u);
    return sums;
}

void add_quanta(inout PhotonSums sums, uvec3 wide, uvec3 half_area) {
    sums.wide += u64vec3(wide);
    sums.half_area += u64vec3(half_area);
}

// Irradiance of a sum over an area, W / voxel^2.
vec3 irradiance(u64vec3 sum, float area) {
    precise vec3 quanta =
        vec3(photon_sum(unpack32(sum.x)), photon_sum(unpack32(sum.y)), photon_sum(unpack32(sum.z)));
    precise vec3 watts = quanta * photon.power_unit;
    precise vec3 density = watts / area;
    return density;
}

// Squared radii of a point's two kernels.
struct Discs {
    float squared;
    float half_area_squared;
};

Discs common_discs() {
    Discs discs;
    discs.squared = photon.radius * photon.radius;
    discs.half_area_squared = photon.half_area_radius * photon.half_area_radius;
    return discs;
}

// Writes the irradiance of a pixel's sums, when these fractions of its kernels can receive photons.
void store_light(uint index, PhotonSums sums, Discs discs, float share, float half_area_share) {
    precise float area = kPi * discs.squared * share;
    precise float half_area = kPi * discs.half_area_squared * half_area_share;
    light[index] = irradiance(sums.wide, area);
    half_area_light[index] = irradiance(sums.half_area, half_area);
}

#endif
