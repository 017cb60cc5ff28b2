#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// A film tile for display: 8-bit sRGB codes of the means of a plane, four pixels per invocation.

#include "lib/address.glsl"

#include "lib/invocation.glsl"

#include "lib/constants.glsl"
#include "lib/texel_planes.glsl"
#include "shared/false_colour.h"
#include "shared/film_sum.h"
#include "shared/tone_curve.h"
#include "shared/window.h"

VX_SPECIALIZED(uint, shows, 0u);       // kShows*
VX_SPECIALIZED(uint, compares, 0u);    // kCompares*
VX_SPECIALIZED(uint, components, 3u);  // of the plane: 1 or 3
VX_SPECIALIZED(uint, has_halves, 1u);  // the plane is the sum of two halves
VX_SPECIALIZED(uint, has_floats, 0u);  // the plane holds floats, not sums
VX_SPECIALIZED(uint, is_filmic, 1u);
VX_SPECIALIZED(uint, is_bgr, 0u);  // else red is the lowest byte

layout(rgba32ui) readonly uniform uimageBuffer Values;
layout(rgba32ui) readonly uniform uimageBuffer OtherHalf;
layout(scalar) readonly buffer Reference {
    float reference[];  // [height][width][3] radiance
};
layout(scalar) writeonly buffer Display {
    uint display[];
};
layout(push_constant, scalar) uniform Push {
    DisplayResolvePush push;
};

// Two sums of a texel as floats.
vec2 floats_of(uvec4 sums) {
    return vec2(film_float(sums.xy), film_float(sums.zw));
}

// The sums of three components of a group of pixels.
#define VX_GROUP_SUMS(plane, group)                                                              \
    vectors_of(vec4(floats_of(VX_TEXEL(plane, 6u * (group))), floats_of(VX_TEXEL(plane, 6u * (group) + 1u))),      \
               vec4(floats_of(VX_TEXEL(plane, 6u * (group) + 2u)), floats_of(VX_TEXEL(plane, 6u * (group) + 3u))), \
               vec4(floats_of(VX_TEXEL(plane, 6u * (group) + 4u)), floats_of(VX_TEXEL(plane, 6u * (group) + 5u))))

vec3[kGroupPixels] numbers(vec4 values) {
    return vec3[kGroupPixels](vec3(values.x), vec3(values.y), vec3(values.z), vec3(values.w));
}

vec3[kGroupPixels] load_values(uint group) {
    if (has_floats != 0u)
        return components == 1u ? numbers(VX_FLOATS(Values, group)) : VX_GROUP_VECTORS(Values, group, 1u);
    if (components == 1u)
        return numbers(vec4(floats_of(VX_TEXEL(Values, 2u * group)), floats_of(VX_TEXEL(Values, 2u * group + 1u))));
    return VX_GROUP_SUMS(Values, group);
}

// The standard error of the luminance of a mean of n samples, as in film_image(). The samples with even
// numbers are in `even`.
float error_of(vec3 even, vec3 odd, uint n) {
    if (n < 2u) return luminance_of(even + odd);
    float odd_samples = float(n / 2u);
    float even_samples = float(n - n / 2u);
    float difference = luminance_of(even) / even_samples - luminance_of(odd) / odd_samples;
    return abs(difference) * sqrt(even_samples * odd_samples) / float(n);
}

vec3 tone(vec3 radiance) {
    vec3 exposed = max(radiance, 0.0) * push.exposure;
    for (uint c = 0u; c < 3u; ++c)
        exposed[c] = encode_srgb(is_filmic != 0u ? filmic_curve(exposed[c]) : min(exposed[c], 1.0));
    return exposed;
}

vec3 radiance_codes(vec3 mean, uint row, uint column) {
    if (compares != kComparesNothing && column >= push.divider) {
        uint at = 3u * (row * push.width + column);
        vec3 other = vec3(reference[at], reference[at + 1u], reference[at + 2u]);
        if (compares == kComparesMap) return false_colour(other.x);
        mean = compares == kComparesReference ? other : abs(mean - other);
    }
    return tone(mean);
}

// sRGB codes in [0,1].
vec3 codes_of(vec3 value, vec3 other, uint row, uint column) {
    uint samples = push.samples + (row < push.rows_ahead ? 1u : 0u);
    vec3 mean = has_floats != 0u ? value : (value + other) / max(float(samples), 1.0);
    if (shows == kShowsRadiance) return radiance_codes(mean, row, column);
    if (shows == kShowsAlbedo) {
        vec3 albedo = clamp(mean, 0.0, 1.0);
        return vec3(encode_srgb(albedo.x), encode_srgb(albedo.y), encode_srgb(albedo.z));
    }
    if (shows == kShowsError) mean.x = log(max(error_of(value, other, samples), 1e-20)) * 0.43429448;
    vec3 place = (mean - push.low) / (push.high - push.low);
    return shows == kShowsVector ? clamp(place, 0.0, 1.0) : false_colour(place.x);
}

void main() {
    uint group = linear_id();
    if (kGroupPixels * group >= push.pixel_count) return;
    vec3 values[kGroupPixels] = load_values(group);
    vec3 others[kGroupPixels] = repeated(0.0);
    if (has_halves != 0u) others = VX_GROUP_SUMS(OtherHalf, group);
    for (uint k = 0u; k < kGroupPixels; ++k) {
        uint pixel = kGroupPixels * group + k;
        if (pixel >= push.pixel_count) return;
        uint row = push.first_row + pixel / push.width;
        vec3 codes = codes_of(values[k], others[k], row, pixel % push.width);
        if (is_bgr != 0u) codes = codes.zyx;
        display[push.first_row * push.width + pixel] = packUnorm4x8(vec4(codes, 1.0));
    }
}
