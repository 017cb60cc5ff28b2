#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// Aerial perspective: what the air between the camera and its first hit takes of the light from there, multiplied with
// what mirrors and glass leave, and what it adds. Misses see the air in the sky.

#include "lib/address.glsl"

#define VX_GROUP_2D
#include "lib/invocation.glsl"

#include "lib/hits.glsl"
#include "lib/samples.glsl"
#include "lib/sky_build.glsl"
#include "lib/sky_params.glsl"
#include "shared/aerial.h"
#include "shared/sky_path.h"

VX_SPECIALIZED(uint, hits_stride, 1u);
VX_SPECIALIZED(uint, weights_stride, 1u);

layout(scalar) readonly buffer Weights {
    vec3 weights[];
};
layout(scalar) writeonly buffer DimmedWeights {
    vec3 dimmed_weights[];
};
layout(scalar) writeonly buffer AerialLight {
    vec3 aerial_light[];
};

Aerial aerial_to(Hit hit, Pixel pixel) {
    Ray ray = camera_ray_of(pixel);
    vec3 way = vec3(hit.cell - ray.cell) + (hit.fraction - ray.fraction);
    float z = float(frame.world_origin.z + ray.cell.z) + ray.fraction.z;
    AirPart part = air_part(sky, ray.direction, z, length(way));
    if (traces_air == 0u) return aerial_of(sky.air, part);
    Aerial aerial;
    aerial.passes = passes_all(sky.air, part);
    aerial.light = traced_light(sky.air, part.ray, part.way.end, air_noise(pixel_key(pixel), 0u));
    return aerial;
}

void main() {
    Pixel pixel = this_pixel();
    if (!pixel.inside) return;
    Hit hit = load_hit(pixel.index * hits_stride);
    bool is_hit = hit.face <= kFaceSphereInside;
    Aerial aerial = aerial_to(hit, pixel);
    vec3 weight = weights[pixel.index * weights_stride];
    dimmed_weights[pixel.index] = is_hit ? weight * aerial.passes : weight;
    aerial_light[pixel.index] = is_hit ? sky.irradiance * aerial.light : vec3(0.0);
}
