// Out = In + step, or In - step: specialization constants of two types.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lib/constants.glsl"
#include "lib/invocation.glsl"

VX_SPECIALIZED(uint, step, 1u);
VX_SPECIALIZED(bool, is_negative, false);

layout(scalar) readonly buffer In { uint inputs[]; };
layout(scalar) writeonly buffer Out { uint outputs[]; };
layout(scalar) buffer Unused { uint unused[]; };
layout(push_constant, scalar) uniform Push { uint count; } push;

void main() {
    uint i = linear_id();
    if (i >= push.count) return;
    outputs[i] = is_negative ? inputs[i] - step : inputs[i] + step;
}
