// Writes the arguments of an indirect dispatch for `count` invocations in groups of 64.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lib/invocation.glsl"

layout(scalar) writeonly buffer Groups {
    uint x;
    uint y;
    uint z;
} groups;
layout(push_constant, scalar) uniform Push { uint count; } push;

void main() {
    if (linear_id() > 0u) return;
    groups.x = (push.count + 63u) / 64u;
    groups.y = 1u;
    groups.z = 1u;
}
