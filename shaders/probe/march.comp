#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// Enters the world and marches once per element, as a camera ray does.

#include "lib/address.glsl"
#include "lib/invocation.glsl"

#define VX_PUSH uint count; ivec3 chunks;
#include "lib/world_access.glsl"
#include "probe/march_functions.h"

layout(scalar) readonly buffer In {
    Ray inputs[];
};
layout(scalar) writeonly buffer Out {
    MarchProbe outputs[];
};

void main() {
    init_world();
    uint i = linear_id();
    if (i >= count) return;
    outputs[i] = probe_march(inputs[i], chunks);
}
