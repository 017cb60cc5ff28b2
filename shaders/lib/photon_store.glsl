// How a pass that traces photons hands them over. Include lib/address.glsl first.
#ifndef VX_PHOTON_STORE_GLSL
#define VX_PHOTON_STORE_GLSL

#extension GL_KHR_shader_subgroup_basic : require

#include "lib/photon_frame.glsl"
#include "lib/tally_access.glsl"
#include "shared/photon_cell.h"
#include "shared/photon_power.h"

layout(constant_id = 30) const uint sorts_photons = 1u;  // 0: whoever reads them needs no order

layout(scalar) buffer PhotonHeads {
    PhotonHead head;
};
layout(scalar) writeonly buffer StoredPhotons {
    StoredPhoton stored[];
};
layout(scalar) buffer BucketCounts {
    uint bucket_counts[];
};

bool is_finite(vec3 v) {
    uint largest = max(max(floatBitsToUint(v.x) & 0x7FFFFFFFu, floatBitsToUint(v.y) & 0x7FFFFFFFu),
                       floatBitsToUint(v.z) & 0x7FFFFFFFu);
    return largest < 0x7F800000u;
}

// Keeps a photon: where it met a surface, local to the world, photon_surface() of it, and its power in watts before the
// surface takes its share. Any invocations may call it, the others of their subgroup need not. A photon without a
// finite place or beyond the capacity is lost and counted.
void store_photon(vec3 position, uint surface, vec3 power) {
    // One atomic for all that store at once.
    uvec4 storing = subgroupBallot(true);
    uint first = 0u;
    if (subgroupElect()) first = atomicAdd(head.count, subgroupBallotBitCount(storing));
    uint slot = subgroupBroadcastFirst(first) + subgroupBallotExclusiveBitCount(storing);
    bool is_placed = is_finite(position);
    PackedPower packed = pack_power(power, photon.power_scale, position);
    count(kFaultPhotonPower, is_placed && packed.is_sound ? 0u : 1u);
    count(kFaultPhotonStoreFull, slot < photon.capacity ? 0u : 1u);
    if (slot >= photon.capacity) return;
    StoredPhoton kept;
    kept.position = is_placed ? position : vec3(0.0);
    kept.surface = is_placed ? surface : kNoSurface;
    kept.power = packed.words;
    kept.bucket = photon_bucket(kept.position, kept.surface, photon.grid);
    kept.rank = 0u;
    // The rank among those of the bucket makes a second atomic in photon_sort unnecessary.
    if (sorts_photons != 0u) kept.rank = atomicAdd(bucket_counts[kept.bucket], 1u);
    stored[slot] = kept;
}

#endif
