#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// Fraction of cosine-distributed rays from each hit that meet nothing within the radius; 1 for unoccluded
// hits and for misses.

#include "lib/address.glsl"

#define VX_GROUP_2D
#include "lib/invocation.glsl"

#include "lib/occlusion.glsl"

layout(scalar) readonly buffer Hits {
    Hit hits[];
};
layout(scalar) writeonly buffer Ao {
    float ao[];
};

void main() {
    init_scene();
    Pixel pixel = this_pixel();
    if (!pixel.inside) return;
    Hit hit = hits[pixel.index];
    float visibility = 1.0;
    if (hit.face == kFaceInside) visibility = 0.0;
    bool traced = is_surface(hit) && hit.face != kFaceInside;
    if (traced) visibility = trace_visibility(pixel, hit, first_ray(frame.sample_index, ao_rays));
    count(kWorkAoRays, traced ? ao_rays : 0u);
    ao[pixel.index] = visibility;
}
