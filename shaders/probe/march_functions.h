// What the march probe computes from one ray: the same function runs on the device and, compiled as C++,
// beside it. The including file must define world access, see march.h.
#ifndef VX_MARCH_FUNCTIONS_H
#define VX_MARCH_FUNCTIONS_H

#include "shared/camera.h"

VX_BEGIN

struct MarchProbe {
    Ray entry;  // the ray restarted at the world's border
    float entry_t;
    uint enters;
    MarchHit hit;   // of the restarted ray
    vec3 fraction;  // of the hit, 0 on a miss
};

VX_FN MarchProbe probe_march(VX_WORLD_PARAM Ray ray, ivec3 chunks) {
    const WorldEntry entry = enter_world(ray, chunks << kChunkLog2);
    MarchProbe probe;
    probe.entry = entry.ray;
    probe.entry_t = entry.t;
    probe.enters = entry.enters ? 1u : 0u;
    probe.hit = march(VX_WORLD_ARG entry.ray, chunks);
    probe.fraction = probe.hit.face == kFaceMiss ? vec3(0.0f) : hit_fraction(entry.ray, probe.hit);
    return probe;
}

VX_END

#endif
