#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// Share of cosine-weighted rays off each hit that meet nothing within the radius: 1 in the open, and for misses.

#include "lib/address.glsl"

#define VX_GROUP_2D
#include "lib/invocation.glsl"

#include "lib/surface.glsl"

layout(scalar) readonly buffer Hits {
    Hit hits[];
};
layout(scalar) writeonly buffer Ao {
    float ao[];
};

float trace_openness(Pixel pixel, Hit hit) {
    uint own = hit.face == kFaceSphere ? hit.sphere : kNoSphere;
    uint stream = pixel.y * frame.width + pixel.x;
    uvec2 first;  // number of the sample's first ray, 64 bits
    umulExtended(frame.sample_index, frame.ao_rays, first.y, first.x);
    uint open = 0u;
    for (uint i = 0u; i < frame.ao_rays; ++i) {
        uint low = first.x + i;
        SampleKey key = sample_key(stream, uvec2(low, first.y + (low < i ? 1u : 0u)), frame.seed);
        vec2 u = sample_2d(frame.sequence, key, kPairOcclusion);
        vec3 direction = hit.face == kFaceSphere ? cosine_about(surface_normal(hit), u) : cosine_on_face(hit.face, u);
        open += is_occluded(ray_from(hit, direction, frame.ao_radius), own) ? 0u : 1u;
    }
    return float(open) / float(frame.ao_rays);
}

void main() {
    open_world();
    Pixel pixel = this_pixel();
    if (!pixel.inside) return;
    Hit hit = hits[pixel.index];
    float openness = 1.0;
    if (hit.face == kFaceInside) openness = 0.0;
    bool traced = is_surface(hit) && hit.face != kFaceInside;
    if (traced) openness = trace_openness(pixel, hit);
    count(kWorkAoRays, traced ? frame.ao_rays : 0u);
    ao[pixel.index] = openness;
}
