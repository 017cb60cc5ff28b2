#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// The picture over the whole window: linear radiance to sRGB codes, or false colours.

#include "shared/window.h"

layout(scalar, set = 0, binding = 0) readonly buffer Picture {
    float picture[];
};
layout(scalar, set = 0, binding = 1) readonly buffer Reference {
    float reference[];
};
layout(push_constant, scalar) uniform Push {
    WindowPush push;
};
layout(location = 0) out vec4 shown;

vec3 picture_at(ivec2 pixel) {
    ivec2 inside = clamp(pixel, ivec2(0), push.size - 1);
    uint i = 3u * uint(inside.y * push.size.x + inside.x);
    return vec3(picture[i], picture[i + 1u], picture[i + 2u]);
}

// The nearest pixel: four loads and their weights took longer on a CPU than all else in a frame.
vec3 picture_here() {
    return picture_at(ivec2(gl_FragCoord.xy * vec2(push.size) / push.window));
}

vec3 reference_here() {
    vec2 place = gl_FragCoord.xy * vec2(push.reference) / push.window;
    ivec2 inside = clamp(ivec2(place), ivec2(0), push.reference - 1);
    uint i = 3u * uint(inside.y * push.reference.x + inside.x);
    return vec3(reference[i], reference[i + 1u], reference[i + 2u]);
}

// film/tonemap.h: K. Narkowicz (2016).
vec3 filmic(vec3 linear) {
    vec3 x = min(linear * 0.6, vec3(16.0));
    return min(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), vec3(1.0));
}

vec3 encode_srgb(vec3 linear) {
    vec3 low = linear * 12.92;
    vec3 high = 1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055;
    return mix(high, low, lessThanEqual(linear, vec3(0.0031308)));
}

void main() {
    bool has_reference = push.reference.x > 0;
    vec3 value = has_reference && gl_FragCoord.x >= push.wipe ? reference_here() : picture_here();
    if (push.shading == kShadeFalseColour) {
        shown = vec4(false_colour((value.x - push.low) / (push.high - push.low)), 1.0);
        return;
    }
    if (push.shading == kShadeDifference && has_reference) value = abs(picture_here() - reference_here());
    vec3 exposed = max(value, vec3(0.0)) * push.exposure;
    vec3 mapped = push.shading == kShadeFilmic ? filmic(exposed) : min(exposed, vec3(1.0));
    shown = vec4(encode_srgb(mapped), 1.0);
}
