// Reads the words at the given indices, of a bound buffer or of one reached by its address.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lib/address.glsl"
#include "lib/constants.glsl"
#include "lib/invocation.glsl"

VX_SPECIALIZED(bool, is_by_address, true);

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Words { uint words[]; };
layout(scalar) readonly buffer Bound { uint bound[]; };
layout(scalar) readonly buffer Indices { uint indices[]; };
layout(scalar) writeonly buffer Out { uint outputs[]; };
layout(push_constant, scalar) uniform Push {
    Words from;
    uint count;
} push;

void main() {
    Words from = VX_POINTER(Words, push.from);
    uint i = linear_id();
    if (i >= push.count) return;
    uint at = indices[i];
    outputs[i] = is_by_address ? from.words[at] : bound[at];
}
