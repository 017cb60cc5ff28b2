#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// Finds the slot of each hit's occlusion cell where the previous sample saw that cell. All other pixels are
// listed for ao_search. The order of the list depends on the threads; what is found for a pixel does not.

#include "lib/address.glsl"

#define VX_GROUP_2D
#include "lib/invocation.glsl"

#include "lib/frame_access.glsl"
#include "lib/counters_access.glsl"

#include "lib/ao_cells.glsl"
#include "lib/ao_reproject.glsl"

layout(scalar) readonly buffer Hits {
    Hit hits[];
};
layout(scalar) buffer Missed {
    AoMissed missed;
    uint missed_pixels[];
};

// Each workgroup of ao_search takes as many pixels as it has invocations.
void list_missed(uint pixel) {
    uint place = atomicAdd(missed.count, 1u);
    if (place % kLinearGroup == 0u) atomicAdd(missed.groups_x, 1u);
    missed_pixels[place] = pixel;
}

void main() {
    Pixel pixel = this_pixel();
    if (!pixel.inside) return;
    Hit hit = hits[pixel.index];
    bool in_cell = hit.face < kFaceInside;
    uvec2 key = ao_cell_key(cell_of(hit));
    uint slot = kNoSlot;
    if (in_cell) slot = reproject(hit, key);
    if (in_cell && slot == kNoSlot) list_missed(pixel.index);
    touch(key, slot, false);
    count(kWorkAoReused, slot != kNoSlot ? 1u : 0u);
    if (slot != kNoSlot && rests(pixel, slot)) slot |= kSlotRests;
    slots[pixel.index] = slot;
}
