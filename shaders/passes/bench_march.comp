#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// First voxel that each ray of a list meets: what `voxilux bench march` times.

#include "lib/address.glsl"
#include "lib/interleaved_row.glsl"
#include "lib/invocation.glsl"

#define VX_PUSH BenchMarchPush push;
#include "lib/constants.glsl"
#include "lib/world_access.glsl"
#include "shared/camera.h"

// As texels of one word, as passes read what others left (lib/hits.glsl says why).
layout(r32ui) readonly uniform uimageBuffer Rays;
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

// Whether the rays may start outside the world, as camera rays do.
VX_SPECIALIZED(uint, have_entries, 0u);

const uint kRayWords = 10u;

uint ray_word(uint i, uint k) {
    return imageLoad(Rays, int(kRayWords * i + k)).x;
}

Ray load_ray(uint i) {
    Ray ray;
    ray.cell = ivec3(ray_word(i, 0u), ray_word(i, 1u), ray_word(i, 2u));
    ray.fraction = uintBitsToFloat(uvec3(ray_word(i, 3u), ray_word(i, 4u), ray_word(i, 5u)));
    ray.direction = uintBitsToFloat(uvec3(ray_word(i, 6u), ray_word(i, 7u), ray_word(i, 8u)));
    ray.t_max = uintBitsToFloat(ray_word(i, 9u));
    return ray;
}

WorldEntry entry_of(Ray ray) {
    if (have_entries != 0u) return enter_world(ray, push.chunks << kChunkLog2);
    return WorldEntry(ray, 0.0, true);
}

void main() {
    init_world();
    uint i = linear_id();
    if (i >= push.count) return;
    WorldEntry entry = entry_of(load_ray(i));
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
