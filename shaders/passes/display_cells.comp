#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// The occlusion cells of the pixels of the last sample, as 8-bit sRGB codes: how many samples each holds, and
// where one cell ends and the next begins.

#include "lib/address.glsl"

#include "lib/invocation.glsl"

#include "lib/constants.glsl"
#include "shared/cell_age.h"
#include "shared/false_colour.h"
#include "shared/window.h"

VX_SPECIALIZED(uint, is_bgr, 0u);  // else red is

layout(scalar) readonly buffer Slots {
    uint slots[];
};
layout(scalar) readonly buffer Samples {
    uint64_t samples[];
};
layout(scalar) writeonly buffer Display {
    uint display[];
};
layout(push_constant, scalar) uniform Push {
    DisplayCellsPush push;
};

void main() {
    uint pixel = linear_id();
    if (pixel >= push.pixel_count) return;
    uint slot = slots[pixel];
    vec3 codes = vec3(0.0);
    if (slot != kNoSlot) {
        float taken = log(max(float(samples[slot & ~kSlotRests]), 1.0)) * 0.43429448;
        codes = false_colour((taken - push.low) / (push.high - push.low));
    }
    if (is_bgr != 0u) codes = codes.zyx;
    display[pixel] = packUnorm4x8(vec4(codes, 1.0));
}
