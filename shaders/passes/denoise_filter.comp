#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// One level of the a-trous filter of a half.

#define VX_GROUP_2D
#include "lib/invocation.glsl"

#include "lib/denoise_planes.glsl"

VX_SPECIALIZED(uint, fits_slopes, 1u);  // 0: the mean

VX_INPUT(Light);
VX_INPUT(Guide);
VX_OUTPUT(Filtered);

void main() {
    ivec2 place = this_place();
    if (!is_inside(place)) return;
    int at = texel_at(place);
    vec4 guide = VX_LOAD(Guide, at);
    SlopeFit fit = SlopeFit(0.0, vec2(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0));
    float possible = 0.0;
    for (int j = -kDenoiseReach; j <= kDenoiseReach; ++j) {
        for (int i = -kDenoiseReach; i <= kDenoiseReach; ++i) {
            ivec2 tap = place + ivec2(i, j) * push.step;
            bool inside = is_inside(tap);
            int from = inside ? texel_at(tap) : at;
            float near = inside ? tap_weight(i) * tap_weight(j) : 0.0;
            vec4 light = VX_LOAD(Light, from);
            float weight = near * guide_weight(guide, VX_LOAD(Guide, from)) * light.w;
            possible += near;
            fit.weight += weight;
            fit.light += weight * light.xyz;
            if (fits_slopes != 0u) {
                vec2 there = vec2(i, j) / float(kDenoiseReach);
                fit.place += weight * there;
                fit.places += weight * vec3(there.x * there.x, there.x * there.y, there.y * there.y);
                fit.light_x += weight * there.x * light.xyz;
                fit.light_y += weight * there.y * light.xyz;
            }
        }
    }
    vec4 filtered = vec4(0.0);
    if (fit.weight > kLeastWeight)
        filtered = vec4(fits_slopes != 0u ? fitted_light(fit) : fit.light / fit.weight, fit.weight / possible);
    VX_STORE(Filtered, at, filtered);
}
