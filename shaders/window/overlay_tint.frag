#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// A triangle of the user interface: its colour, with the opacity of the font's texel.

#include "shared/window.h"

layout(scalar, set = 0, binding = 0) readonly buffer Font {
    uint font_width;
    uint coverage[];  // four texels per word
};
layout(location = 0) in vec2 texel;
layout(location = 1) in vec4 colour;
layout(location = 0) out vec4 shown;

void main() {
    uint i = uint(texel.y) * font_width + uint(texel.x);
    shown = vec4(colour.rgb, colour.a * unpackUnorm4x8(coverage[i / 4u])[i % 4u]);
}
