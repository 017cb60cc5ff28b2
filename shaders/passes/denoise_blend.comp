#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// Mixes the undenoised image of both halves with the filtered one, and adds the light that is not filtered.

#define VX_GROUP_2D
#include "lib/invocation.glsl"

#include "lib/denoise_planes.glsl"
#include "lib/denoise_share.glsl"

VX_INPUT(ReflectedA);
VX_INPUT(ReflectedB);
VX_INPUT(FilteredA);
VX_INPUT(FilteredB);
VX_INPUT(SharpA);
VX_INPUT(SharpB);
VX_OUTPUT(ResultA);
VX_OUTPUT(ResultB);

// A pixel whose surfaces reflect nothing is left unchanged.
vec3 blended(vec3 plain, vec4 filtered, float share) {
    return filtered.w > 0.0 ? mix(plain, filtered.xyz, share) : plain;
}

void main() {
    ivec2 place = this_place();
    if (!is_inside(place)) return;
    int at = texel_at(place);
    float share = share_of(terms_around(place).xy);
    vec3 a = blended(VX_LOAD(ReflectedA, at).xyz, VX_LOAD(FilteredA, at), share);
    vec3 b = blended(VX_LOAD(ReflectedB, at).xyz, VX_LOAD(FilteredB, at), share);
    VX_STORE(ResultA, at, vec4(VX_LOAD(SharpA, at).xyz + a, share));
    VX_STORE(ResultB, at, vec4(VX_LOAD(SharpB, at).xyz + b, share));
}
