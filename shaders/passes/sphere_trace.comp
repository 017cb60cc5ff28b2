#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// Replaces hits that lie behind an analytic sphere. Earlier hits are read with a stride, 0 when there are none.

#include "lib/address.glsl"

#define VX_GROUP_2D
#include "lib/invocation.glsl"

#include "lib/surface.glsl"

layout(constant_id = 2) const uint hits_stride = 1u;

layout(scalar) readonly buffer VoxelHits {
    Hit voxel_hits[];
};
layout(scalar) writeonly buffer Hits {
    Hit hits[];
};

void main() {
    Pixel pixel = this_pixel();
    if (!pixel.inside) return;
    Hit hit = voxel_hits[pixel.index * hits_stride];
    if (!is_surface(hit)) hit.t = kUnbounded;
    Ray ray = camera_ray(frame, pixel.x, pixel.y);
    vec3 origin = local_position(ray.cell, ray.fraction);
    for (uint i = 0u; i < frame.sphere_count; ++i) {
        SphereHit found = sphere_intersect(spheres[i].shape, origin, ray.direction, 0.0, hit.t);
        if (!found.hit || !(found.t < hit.t)) continue;
        vec3 position = origin + found.t * ray.direction;
        vec3 corner = floor(position);
        hit.cell = ivec3(corner);
        hit.fraction = clamp(position - corner, vec3(0.0), vec3(1.0));
        hit.face = kFaceSphere;
        hit.t = found.t;
        hit.material = spheres[i].material;
        hit.sphere = i;
    }
    if (!is_surface(hit)) hit.t = 0.0;
    hits[pixel.index] = hit;
}
