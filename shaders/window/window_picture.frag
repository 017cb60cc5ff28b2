#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// The picture over the whole window: linear radiance to sRGB codes.

#include "shared/tone_curve.h"
#include "shared/window.h"

layout(scalar, set = 0, binding = 0) readonly buffer Picture {
    float picture[];
};
layout(push_constant, scalar) uniform Push {
    WindowPush push;
};
layout(location = 0) out vec4 shown;

float shown_code(float radiance) {
    float exposed = max(radiance, 0.0) * push.exposure;
    return encode_srgb(push.is_filmic != 0u ? filmic_curve(exposed) : min(exposed, 1.0));
}

// The nearest pixel: four loads and their weights took longer on a CPU than all else in a frame.
void main() {
    ivec2 pixel = clamp(ivec2(gl_FragCoord.xy * vec2(push.size) / push.window), ivec2(0), push.size - 1);
    uint i = 3u * uint(pixel.y * push.size.x + pixel.x);
    shown = vec4(shown_code(picture[i]), shown_code(picture[i + 1u]), shown_code(picture[i + 2u]), 1.0);
}
