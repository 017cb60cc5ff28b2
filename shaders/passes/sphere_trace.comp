#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// Replaces hits that are behind an analytic sphere. Earlier hits are read with a stride, 0 when there are
// none.

#include "lib/address.glsl"

#define VX_GROUP_2D
#include "lib/invocation.glsl"

#include "lib/constants.glsl"
#include "lib/surface.glsl"

VX_SPECIALIZED(uint, hits_stride, 1u);

layout(scalar) readonly buffer VoxelHits {
    Hit voxel_hits[];
};
layout(scalar) writeonly buffer Hits {
    Hit hits[];
};

void main() {
    load_spheres();
    Pixel pixel = this_pixel();
    if (!pixel.inside) return;
    Hit hit = voxel_hits[pixel.index * hits_stride];
    if (!is_surface(hit)) hit.t = kUnbounded;
    Ray ray = camera_ray_of(pixel);
    vec3 origin = local_position(ray.cell, ray.fraction);
    NearestSphere nearest = nearest_sphere(origin, ray.direction, hit.t, kNoSphere);
    hit.t = nearest.t;
    if (nearest.i != kNoSphere) place_on_sphere(hit, nearest.i, spheres[nearest.i], origin, ray.direction);
    if (!is_surface(hit)) hit.t = 0.0;
    hits[pixel.index] = hit;
}
