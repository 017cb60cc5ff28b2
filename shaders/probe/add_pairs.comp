// Adds two numbers: the simplest probe.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lib/invocation.glsl"

struct Pair {
    uint a;
    uint b;
};

layout(scalar) readonly buffer In { Pair pairs[]; };
layout(scalar) writeonly buffer Out { uint sums[]; };
layout(push_constant, scalar) uniform Push { uint count; } push;

void main() {
    uint i = linear_id();
    if (i >= push.count) return;
    sums[i] = pairs[i].a + pairs[i].b;
}
