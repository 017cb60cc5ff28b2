#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// Albedo and normal of each hit; zero for misses.

#include "lib/address.glsl"

#define VX_GROUP_2D
#include "lib/invocation.glsl"

#include "lib/constants.glsl"
#include "lib/surface.glsl"

VX_SPECIALIZED(uint, hits_stride, 1u);

layout(scalar) readonly buffer Hits {
    Hit hits[];
};
layout(scalar) readonly buffer Materials {
    SurfaceMaterial materials[];
};
layout(scalar) writeonly buffer Albedo {
    vec3 albedo[];
};
layout(scalar) writeonly buffer Normal {
    vec3 normal[];
};

void main() {
    Pixel pixel = this_pixel();
    if (!pixel.inside) return;
    Hit hit = hits[pixel.index * hits_stride];
    bool is_hit = is_surface(hit);
    bool has_normal = is_hit && hit.face != kFaceInside;
    albedo[pixel.index] = is_hit ? materials[hit.material].albedo : vec3(0.0);
    normal[pixel.index] = has_normal ? surface_normal(hit) : vec3(0.0);
}
