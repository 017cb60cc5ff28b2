#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// One round of gathering the light that arrives anywhere in the air: a texel of its table (sky_march.h) per
// invocation, from the table of the previous round.

// There are few texels, and each takes long: small groups keep all threads of a software device busy.
#define VX_LINEAR_GROUP 8
#include "lib/invocation.glsl"
#include "lib/sky_build.glsl"

layout(push_constant, scalar) uniform Push {
    SkyScatterPush push;
};
layout(scalar) writeonly buffer NextScatter {
    uvec4 next_scatter[];
};

void main() {
    uint i = linear_id();
    if (i >= kScatterTexels) return;
    SkyHarmonics texel = scatter_texel(push.air, scatter_height(i / kScatterCosines),
                                       scatter_cosine(i % kScatterCosines), push.is_first != 0u);
    for (uint pair = 0u; pair < kTexelPairs; ++pair)
        next_scatter[kTexelPairs * i + pair] = scatter_pair(texel, pair);
}
