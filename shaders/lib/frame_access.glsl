// The frame's parameters and the pixel of an invocation. Passes over pixels are dispatched as column_count x
// row_count.
#ifndef VX_FRAME_ACCESS_GLSL
#define VX_FRAME_ACCESS_GLSL

#include "lib/interleaved_row.glsl"
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
