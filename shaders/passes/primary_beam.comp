#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// The time at which the camera rays of each beam tile may start.

#include "lib/address.glsl"
#include "lib/invocation.glsl"

#include "lib/frame_access.glsl"
#include "lib/projection.glsl"
#include "lib/world_access.glsl"
#include "shared/beam.h"

layout(scalar) writeonly buffer Starts {
    float starts[];
};

void main() {
    init_world();
    uint i = linear_id();
    uint columns = beam_count(frame.column_count);
    if (i >= columns * beam_count(frame.row_count)) return;
    uint x = frame.first_column + i % columns * kBeamPixels;
    uint y = frame.first_row + i / columns * kBeamPixels;
    starts[i] = beam_start(tile_beam(frame, projection, x, y), frame.chunks);
}
