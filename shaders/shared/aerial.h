// Aerial perspective: what the air between the camera and a surface takes of its light, and what it adds. The
// integral along the ray has four Gauss points in the root of the distance: of the added light it is off by
// 0.5 % (rms) up to 5 km, 1 % up to 20 km and 5 % up to 100 km. Shadows of the scene in the air are left out.
//
// The including side defines VX_SKY_PARAM, VX_SKY_ARG and load_scatter() (sky_march.h).
#ifndef VX_AERIAL_H
#define VX_AERIAL_H

#include "sky_march.h"

VX_BEGIN

struct Aerial {
    vec3 passes;  // share of light that comes from the end of the way
    vec3 light;   // that the air adds, per unit of the sun's irradiance
};

// What of a camera ray is in the air.
struct AirPart {
    AirRay ray;
    AirWay way;
};

// z: of the ray's start, voxels. length: to the surface, voxels.
VX_FN AirPart air_part(SkyParams sky, vec3 direction, float z, float length) {
    AirRay ray = air_ray_of(sky, direction);
    ray.height = max(sky.height + sky.km_per_voxel * z, 0.0f);
    const float start = distance_to_air(ray.height, ray.cosine);
    const float inside = start < 0.0f ? 0.0f : max(sky.km_per_voxel * length - start, 0.0f);
    AirPart part;
    part.ray = ray_after(ray, max(start, 0.0f));
    part.ray.height = min(part.ray.height, kAirTop);
    part.way = way_of(part.ray);
    part.way = cut_way(part.way, min(inside, part.way.end));
    return part;
}

VX_FN vec3 passes_all(Air air, AirPart part) {
    const AirRay end = ray_after(part.ray, part.way.end);
    return part.way.end > 0.0f ? passes_from(air, part.ray, part.way, part.way.end, end.height, end.cosine)
                               : vec3(1.0f);
}

VX_FN Aerial aerial_of(VX_SKY_PARAM Air air, AirPart part) {
    const vec3 moments = mie_moments(air.mie_g);
    AirLight light = no_light();
    for (uint i = 0u; i < 4u; ++i) {
        const float u = kFourNode[i];
        light = gather(VX_SKY_ARG air, part.ray, part.way, part.way.end * u * u,
                       2.0f * part.way.end * u * kFourWeight[i], moments, true, light);
    }
    Aerial aerial;
    aerial.passes = passes_all(air, part);
    aerial.light = light.rayleigh * rayleigh_phase(part.ray.sun_angle) +
                   light.mie * mie_phase(air.mie_g, part.ray.sun_angle) + max(light.multiple, vec3(0.0f));
    return aerial;
}

VX_END

#endif
