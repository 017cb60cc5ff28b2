// How a pass that traces photons stores them. Include lib/address.glsl first.
#ifndef VX_PHOTON_STORE_GLSL
#define VX_PHOTON_STORE_GLSL

#include "lib/constants.glsl"
#include "lib/photon_frame.glsl"
#include "lib/photon_words.glsl"
#include "lib/counters_access.glsl"
#include "shared/photon_cell.h"
#include "shared/photon_power.h"

VX_SPECIALIZED(uint, sorts_photons, 1u);  // 0: no reader needs them in order
// Slots that an invocation reserves at a time. More of them save atomics where invocations store many
// photons.
VX_SPECIALIZED(uint, slots_at_once, 1u);

layout(scalar) buffer PhotonHeads {
    PhotonHead head;
};
layout(scalar) writeonly buffer StoredPhotons {
    uint64_t stored_words[];
};
layout(scalar) readonly buffer WantedCells {
    uint wanted_cells[];  // a bit per mark
};
layout(scalar) buffer BucketCounts {
    uint bucket_counts[];
};

bool is_finite(vec3 v) {
    uint largest = max(max(floatBitsToUint(v.x) & 0x7FFFFFFFu, floatBitsToUint(v.y) & 0x7FFFFFFFu),
                       floatBitsToUint(v.z) & 0x7FFFFFFFu);
    return largest < 0x7F800000u;
}

void put_photon(uint slot, StoredPhoton kept) {
    uint first = kStoredWords * slot;
    uvec3 position = floatBitsToUint(kept.position);
    stored_words[first] = pack64(position.xy);
    stored_words[first + 1u] = pack64(uvec2(position.z, kept.surface));
    stored_words[first + 2u] = pack64(kept.power);
    stored_words[first + 3u] = pack64(uvec2(kept.bucket, kept.rank));
}

// Counters of an invocation, added up at its end: an atomic in a loop costs time even where no invocation
// reaches it.
uint kept_photons = 0u;
uint unsound_photons = 0u;
uint late_photons = 0u;

// Slots that it has reserved and not used yet.
uint next_slot = 0u;
uint end_slot = 0u;

uint take_slot() {
    if (next_slot == end_slot) {
        next_slot = atomicAdd(head.count, slots_at_once);
        end_slot = next_slot + slots_at_once;
    }
    return next_slot++;
}

void put_hole(uint slot) {
    uint first = kStoredWords * slot;
    stored_words[first + 1u] = pack64(uvec2(0u, kNoSurface));
    stored_words[first + 3u] = pack64(uvec2(kNoBucket, 0u));
}

// Stores a photon: where it hit a surface, local to the world; photon_surface() of the hit; and its power in
// watts before the surface reflects. May be called in divergent control flow. A photon that no visible point
// needs is skipped; one without a finite position or beyond the capacity is lost and counted.
void store_photon(vec3 position, uint surface, vec3 power) {
    bool is_placed = is_finite(position);
    uint key = photon_key(is_placed ? position : vec3(0.0), surface, photon.grid);
    uint mark = photon_mark(key, photon.grid);
    bool is_wanted = (wanted_cells[mark >> 5u] >> (mark & 31u) & 1u) != 0u;
    unsound_photons += is_placed ? 0u : 1u;
    if (!is_placed || !is_wanted) return;
    PackedPower packed = pack_power(power, photon.power_scale, position);
    uint slot = take_slot();
    unsound_photons += packed.is_sound ? 0u : 1u;
    late_photons += slot < photon.capacity ? 0u : 1u;
    if (slot >= photon.capacity) return;
    ++kept_photons;
    StoredPhoton kept;
    kept.position = position;
    kept.surface = surface;
    kept.power = packed.words;
    kept.bucket = key & photon.grid.mask;
    kept.rank = 0u;
    // The rank within the bucket saves a second atomic in photon_sort.
    if (sorts_photons != 0u) kept.rank = atomicAdd(bucket_counts[kept.bucket], 1u);
    put_photon(slot, kept);
}

// Marks reserved slots that were not used as empty, and adds the counters. Call it at the end of main().
void close_store() {
    for (; next_slot != end_slot; ++next_slot)
        if (next_slot < photon.capacity) put_hole(next_slot);
    count(kWorkPhotonsStored, kept_photons);
    count(kFaultPhotonPower, unsound_photons);
    count(kFaultPhotonStoreFull, late_photons);
}

#endif
