#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// Terms of the best mixture: of each level of the filter with the next coarser one, or finally of the
// undenoised image with the filtered one. What is compared is reflected light.

#define VX_GROUP_2D
#include "lib/invocation.glsl"

#include "lib/denoise_planes.glsl"

VX_SPECIALIZED(uint, is_last, 0u);

VX_INPUT(ReflectedA);
VX_INPUT(ReflectedB);
VX_INPUT(AlbedoA);
VX_INPUT(AlbedoB);
VX_INPUT(SharpA);
VX_INPUT(SharpB);
VX_INPUT(FineA);
VX_INPUT(FineB);
VX_INPUT(MiddleA);
VX_INPUT(MiddleB);
VX_INPUT(CoarseA);
VX_INPUT(CoarseB);
VX_OUTPUT(Terms);

void main() {
    ivec2 place = this_place();
    if (!is_inside(place)) return;
    int at = texel_at(place);
    vec3 raw_a = VX_LOAD(ReflectedA, at).xyz;
    vec3 raw_b = VX_LOAD(ReflectedB, at).xyz;
    vec3 sharp = 0.5 * (VX_LOAD(SharpA, at).xyz + VX_LOAD(SharpB, at).xyz);
    vec4 terms = vec4(0.0);
    if (is_last != 0u) {
        vec3 filtered_a = VX_LOAD(FineA, at).xyz;
        vec3 filtered_b = VX_LOAD(FineB, at).xyz;
        vec3 seen = sharp + 0.5 * (filtered_a + filtered_b);
        vec3 scale = 1.0 / (seen * seen + kDenoiseEpsilon);
        terms.xy = share_terms(raw_a, filtered_a, raw_b, scale) + share_terms(raw_b, filtered_b, raw_a, scale);
    } else {
        vec3 albedo_a = VX_LOAD(AlbedoA, at).xyz;
        vec3 albedo_b = VX_LOAD(AlbedoB, at).xyz;
        vec3 fine_a = albedo_a * VX_LOAD(FineA, at).xyz;
        vec3 fine_b = albedo_b * VX_LOAD(FineB, at).xyz;
        vec3 middle_a = albedo_a * VX_LOAD(MiddleA, at).xyz;
        vec3 middle_b = albedo_b * VX_LOAD(MiddleB, at).xyz;
        vec3 coarse_a = albedo_a * VX_LOAD(CoarseA, at).xyz;
        vec3 coarse_b = albedo_b * VX_LOAD(CoarseB, at).xyz;
        vec3 seen = sharp + 0.5 * (middle_a + middle_b);
        vec3 scale = 1.0 / (seen * seen + kDenoiseEpsilon);
        terms.xy = share_terms(fine_a, middle_a, raw_b, scale) + share_terms(fine_b, middle_b, raw_a, scale);
        terms.zw = share_terms(middle_a, coarse_a, raw_b, scale) + share_terms(middle_b, coarse_b, raw_a, scale);
    }
    VX_STORE(Terms, at, terms);
}
