#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// Mixes the levels of the filter for both halves.

#define VX_GROUP_2D
#include "lib/invocation.glsl"

#include "lib/denoise_planes.glsl"
#include "lib/denoise_share.glsl"

VX_INPUT(FineA);
VX_INPUT(FineB);
VX_INPUT(MiddleA);
VX_INPUT(MiddleB);
VX_INPUT(CoarseA);
VX_INPUT(CoarseB);
VX_INPUT(LightA);  // unfiltered, for its weights
VX_INPUT(LightB);
VX_OUTPUT(MixedA);
VX_OUTPUT(MixedB);

void main() {
    ivec2 place = this_place();
    if (!is_inside(place)) return;
    int at = texel_at(place);
    vec4 terms = terms_around(place);
    float of_middle = share_of(terms.xy);
    float of_coarse = of_middle * share_of(terms.zw);
    vec3 middle_a = VX_LOAD(MiddleA, at).xyz;
    vec3 middle_b = VX_LOAD(MiddleB, at).xyz;
    vec3 mixed_a = mix(VX_LOAD(FineA, at).xyz, middle_a, of_middle) + of_coarse * (VX_LOAD(CoarseA, at).xyz - middle_a);
    vec3 mixed_b = mix(VX_LOAD(FineB, at).xyz, middle_b, of_middle) + of_coarse * (VX_LOAD(CoarseB, at).xyz - middle_b);
    VX_STORE(MixedA, at, vec4(mixed_a, VX_LOAD(LightA, at).w));
    VX_STORE(MixedB, at, vec4(mixed_b, VX_LOAD(LightB, at).w));
}
