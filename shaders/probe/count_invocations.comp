// Adds one to the element of each invocation, so that the host can check which ran and how often.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lib/invocation.glsl"

layout(scalar) buffer Counts { uint counts[]; };
layout(push_constant, scalar) uniform Push { uint count; } push;

void main() {
    uint i = linear_id();
    if (i >= push.count) return;
    counts[i] += 1u;
}
