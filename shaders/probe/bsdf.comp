#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// Runs probe_bsdf() once per element.

#include "lib/invocation.glsl"

#include "probe/probe_functions.h"

layout(scalar) readonly buffer In {
    BsdfIn inputs[];
};
layout(scalar) writeonly buffer Out {
    BsdfOut outputs[];
};
layout(push_constant, scalar) uniform Push {
    uint count;
};

void main() {
    uint i = linear_id();
    if (i >= count) return;
    outputs[i] = probe_bsdf(inputs[i]);
}
