#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// Divides the light of a half by its albedo, and computes the guide of each pixel.

#define VX_GROUP_2D
#include "lib/invocation.glsl"

#include "lib/denoise_planes.glsl"

VX_INPUT(Reflected);
VX_INPUT(Albedo);
VX_INPUT(Normal);
VX_OUTPUT(Light);
VX_OUTPUT(Guide);

void main() {
    ivec2 place = this_place();
    if (!is_inside(place)) return;
    int at = texel_at(place);
    VX_STORE(Light, at, received_light(VX_LOAD(Reflected, at).xyz, VX_LOAD(Albedo, at).xyz));
    VX_STORE(Guide, at, guide_of(VX_LOAD(Normal, at)));
}
