#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// First voxel that each ray of a list hits, entering the world as camera rays do: what `voxilux bench march`
// times.

#include "lib/address.glsl"
#include "lib/interleaved_row.glsl"
#include "lib/invocation.glsl"

#define VX_PUSH BenchMarchPush push;
#include "lib/constants.glsl"
#include "lib/world_access.glsl"
#include "shared/camera.h"

layout(scalar) readonly buffer Rays {
    Ray rays[];
};
layout(scalar) readonly buffer Starts {
    float starts[];
};
layout(scalar) writeonly buffer BenchHits {
    BenchHit hits[];
};

// Whether the rays are those of a camera, in whole tiles, and start where the beams around these end.
VX_SPECIALIZED(uint, has_beams, 0u);

// Time since its entry into the world at which a ray starts. Rows of tiles come interleaved (bench_rays.h).
float start_of(uint i, float entry) {
    if (has_beams == 0u) return 0.0;
    uint tile = i / (kBeamPixels * kBeamPixels);
    uint row = interleaved_row(tile / push.beams.x, push.beams.y);
    return starts[row * push.beams.x + tile % push.beams.x] - entry;
}

void main() {
    init_world();
    uint i = linear_id();
    if (i >= push.count) return;
    WorldEntry entry = enter_world(rays[i], push.chunks << kChunkLog2);
    BenchHit hit;
    hit.cell = ivec3(-1);
    hit.face = kFaceMiss;
    hit.t = 0.0;
    hit.steps = 0u;
    if (entry.enters) {
        MarchHit found = march_from(entry.ray, push.chunks, start_of(i, entry.t));
        hit.cell = found.cell;
        hit.face = found.face;
        hit.t = entry.t + found.t;
        hit.steps = found.steps;
    }
    hits[i] = hit;
}
