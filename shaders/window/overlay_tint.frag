#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// A triangle of the user interface: its colour, with the opacity of the font's texel.

#include "shared/window.h"

// Four texels per word. As a texel buffer, since lavapipe loads from it for eight fragments at once.
layout(r32ui, set = 0, binding = 0) readonly uniform uimageBuffer Font;
layout(push_constant, scalar) uniform Push {
    WindowPush push;
};
layout(location = 0) in vec2 texel;
layout(location = 1) in vec4 colour;
layout(location = 0) out vec4 shown;

void main() {
    uint i = uint(texel.y) * push.font_width + uint(texel.x);
    uint coverage = imageLoad(Font, int(i / 4u)).x >> (8u * (i % 4u)) & 0xFFu;
    shown = vec4(colour.rgb, colour.a * float(coverage) / 255.0);
}
