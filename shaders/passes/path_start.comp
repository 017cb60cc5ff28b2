#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// Where the path of each visible point starts: its first direction by the cosine, and what emitters were found to send
// there straight. A pass of its own, because software devices would run through it in every turn of the loop of
// path_trace. Directions of zero start no path.

#include "lib/address.glsl"

#define VX_GROUP_2D
#include "lib/invocation.glsl"

#include "lib/path.glsl"

#include "lib/photon_start.glsl"

VX_SPECIALIZED(uint, direct_stride, 1u);
VX_SPECIALIZED(uint, media_stride, 0u);

layout(scalar) readonly buffer Hits {
    Hit hits[];
};
// Materials of the glass voxels that visible points are in.
layout(scalar) writeonly buffer Media {
    uint media[];
};
layout(scalar) readonly buffer Direct {
    vec3 direct[];
};

uint medium_at(Ray ray) {
    ray.t_max = kProbeLength;
    WorldEntry entry = enter_world(ray, frame.chunks << kChunkLog2);
    if (!entry.enters) return kNoMedium;
    MarchHit met = march(entry.ray, frame.chunks);
    count(kFaultRayUnsound, met.fault == kMarchUnsound ? 1u : 0u);
    return met.face == kFaceInside && is_glass(met.material) ? met.material : kNoMedium;
}

void main() {
    init_world();
    Pixel pixel = this_pixel();
    if (!pixel.inside) return;
    Hit hit = hits[pixel.index];
    PhotonStart start;
    start.cell = ivec3(-1);
    start.fraction = vec3(0.5);
    start.direction = vec3(0.0);
    start.sphere = kNoSphere;
    start.power = direct[pixel.index * direct_stride];
    start.noise = pixel_stream(pixel);
    if (is_surface(hit) && hit.face != kFaceInside) {
        vec2 u = draw_2d(pixel_key(pixel), kPairPath);
        Ray ray = ray_from(hit, cosine_about(surface_normal(hit), u), kUnbounded);
        start.cell = ray.cell;
        start.fraction = ray.fraction;
        start.direction = ray.direction;
        start.sphere = own_sphere(hit);
        if (media_stride != 0u) media[pixel.index] = medium_at(ray);
    }
    put_start(pixel.index, start);
}
