// Writes words at the given indices of a buffer reached by its address.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lib/address.glsl"
#include "lib/invocation.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer Words { uint words[]; };
layout(scalar) readonly buffer Indices { uint indices[]; };
layout(scalar) readonly buffer In { uint inputs[]; };
layout(push_constant, scalar) uniform Push {
    Words to;
    uint count;
} push;

void main() {
    Words to = VX_POINTER(Words, push.to);
    uint i = linear_id();
    if (i >= push.count) return;
    to.words[indices[i]] = inputs[i];
}
