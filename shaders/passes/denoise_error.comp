#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// The denoised image, and error estimates of each pixel by itself, which are noisy and unbiased.

#define VX_GROUP_2D
#include "lib/invocation.glsl"

#include "lib/denoise_planes.glsl"

VX_INPUT(ReflectedA);
VX_INPUT(ReflectedB);
VX_INPUT(SharpA);
VX_INPUT(SharpB);
VX_INPUT(ResultA);
VX_INPUT(ResultB);
VX_OUTPUT(Picture);  // R G B and its relMSE
VX_OUTPUT(Errors);   // the variance in that; relMSE of the undenoised image; squared error of the luminance

vec3 mean_at(ivec2 place) {
    int at = texel_at(place);
    return mix(VX_LOAD(ResultB, at).xyz, VX_LOAD(ResultA, at).xyz, push.share);
}

// A conservative estimate of the true value: the smaller of the pixel and the mean around it.
vec3 likely_value(ivec2 place, vec3 own) {
    vec3 sum = vec3(0.0);
    float count = 0.0;
    for (int i = 0; i < 9; ++i) {
        ivec2 other = place + ivec2(i % 3, i / 3) - 1;
        float counts = is_inside(other) ? 1.0 : 0.0;
        sum += counts * mean_at(is_inside(other) ? other : place);
        count += counts;
    }
    return min(abs(own), abs(sum / count));
}

void main() {
    ivec2 place = this_place();
    if (!is_inside(place)) return;
    int at = texel_at(place);
    vec3 a = VX_LOAD(ReflectedA, at).xyz + VX_LOAD(SharpA, at).xyz;
    vec3 b = VX_LOAD(ReflectedB, at).xyz + VX_LOAD(SharpB, at).xyz;
    vec3 filtered_a = VX_LOAD(ResultA, at).xyz;
    vec3 filtered_b = VX_LOAD(ResultB, at).xyz;
    vec3 mean = mean_at(place);
    vec3 value = likely_value(place, mean);
    vec3 scale = 1.0 / (3.0 * (value * value + kDenoiseEpsilon));
    vec3 apart = filtered_a - filtered_b;
    float variance = dot(push.share * (1.0 - push.share) * apart * apart, scale);
    vec3 of_luminance = squared_error(
        vec3(luminance_of(filtered_a)), vec3(luminance_of(filtered_b)), vec3(luminance_of(a)),
        vec3(luminance_of(b)), push.share);
    VX_STORE(Picture, at, vec4(mean, dot(squared_error(filtered_a, filtered_b, a, b, push.share), scale)));
    vec3 of_plain = squared_error(a, b, a, b, push.share);
    VX_STORE(Errors, at, vec4(variance, dot(of_plain, scale), of_luminance.x, 0.0));
}
