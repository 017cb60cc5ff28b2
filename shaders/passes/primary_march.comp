#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// First voxel that each camera ray of the tile hits.

#include "lib/address.glsl"

#define VX_GROUP_2D
#include "lib/invocation.glsl"

#include "lib/frame_access.glsl"
#include "lib/samples.glsl"
#include "lib/counters_access.glsl"
#include "lib/world_access.glsl"
#include "shared/beam.h"

layout(scalar) readonly buffer Starts {
    float starts[];
};
layout(scalar) writeonly buffer Hits {
    Hit hits[];
};

// Start of the beam tile that contains the pixel.
float start_of(Pixel pixel) {
    uint column = (pixel.x - frame.first_column) / kBeamPixels;
    uint row = (pixel.y - frame.first_row) / kBeamPixels;
    return starts[row * beam_count(frame.column_count) + column];
}

Hit no_hit() {
    Hit hit;
    hit.cell = ivec3(-1);
    hit.face = kFaceMiss;
    hit.fraction = vec3(0.0);
    hit.t = 0.0;
    hit.material = 0u;
    hit.sphere = 0u;
    return hit;
}

void main() {
    init_world();
    Pixel pixel = this_pixel();
    if (!pixel.inside) return;
    Hit hit = no_hit();
    WorldEntry entry = enter_world(camera_ray_of(pixel), frame.chunks << kChunkLog2);
    if (entry.enters) {
        MarchHit found = march_from(entry.ray, frame.chunks, start_of(pixel) - entry.t);
        count(kFaultRayUnsound, found.fault == kMarchUnsound ? 1u : 0u);
        count(kFaultMarchExhausted, found.fault == kMarchExhausted ? 1u : 0u);
        if (found.face != kFaceMiss) {
            hit.cell = found.cell;
            hit.face = found.face;
            hit.fraction = hit_fraction(entry.ray, found);
            hit.t = entry.t + found.t;
            hit.material = found.material;
        }
    }
    hits[pixel.index] = hit;
}
