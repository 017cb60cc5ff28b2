// The frame's parameters and the pixel of an invocation. Passes over pixels are dispatched as column_count x
// row_count.
#ifndef VX_FRAME_ACCESS_GLSL
#define VX_FRAME_ACCESS_GLSL

#include "shared/gpu_types.h"

layout(scalar) uniform Frame {
    FrameParams frame;
};

struct Pixel {
    uint x;      // image column
    uint y;      // image row, 0 at the top
    uint index;  // in the buffers of this tile
    bool inside;
};

// Software devices give each thread a contiguous part of the workgroups, and the sky is cheap. Rows of groups
// are therefore dealt alternately to both halves, so that an image with sky at the top keeps all threads
// busy.
uint interleaved_row(uint row, uint rows) {
    uint first_half = (rows + 1u) / 2u;
    return row < first_half ? 2u * row : 2u * (row - first_half) + 1u;
}

Pixel this_pixel() {
    uint group_row = interleaved_row(gl_WorkGroupID.y, gl_NumWorkGroups.y);
    uint row = group_row * gl_WorkGroupSize.y + gl_LocalInvocationID.y;
    Pixel pixel;
    uint column = gl_GlobalInvocationID.x;
    pixel.x = frame.first_column + column;
    pixel.y = frame.first_row + row;
    pixel.index = frame.first_element + row * frame.column_count + column;
    pixel.inside = column < frame.column_count && row < frame.row_count;
    return pixel;
}

#endif
