// Writes to each pixel its index and the size of the workgroup it ran in.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#define VX_GROUP_2D
#include "lib/invocation.glsl"

struct Pixel {
    uint index;
    uint group_x;
    uint group_y;
};

layout(scalar) writeonly buffer Pixels { Pixel pixels[]; };
layout(push_constant, scalar) uniform Push {
    uint width;
    uint height;
} push;

void main() {
    uvec2 at = gl_GlobalInvocationID.xy;
    if (at.x >= push.width || at.y >= push.height) return;
    uint index = at.y * push.width + at.x;
    pixels[index] = Pixel(index, gl_WorkGroupSize.x, gl_WorkGroupSize.y);
}
