#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// First voxel that each ray of a list hits, entering the world as camera rays do: what `voxilux bench march`
// times.

#include "lib/address.glsl"
#include "lib/invocation.glsl"

#define VX_PUSH BenchMarchPush push;
#include "lib/constants.glsl"
#include "lib/world_access.glsl"
#include "shared/camera.h"

layout(scalar) readonly buffer Rays {
    Ray rays[];
};
layout(scalar) writeonly buffer BenchHits {
    BenchHit hits[];
};

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
        MarchHit found = march(entry.ray, push.chunks);
        hit.cell = found.cell;
        hit.face = found.face;
        hit.t = entry.t + found.t;
        hit.steps = found.steps;
    }
    hits[i] = hit;
}
