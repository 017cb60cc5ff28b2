#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// Finds the slot of each hit's occlusion cell in the table.

#include "lib/address.glsl"

#define VX_GROUP_2D
#include "lib/invocation.glsl"

#include "lib/frame_access.glsl"
#include "lib/counters_access.glsl"

#include "lib/ao_cells.glsl"

layout(scalar) readonly buffer Hits {
    Hit hits[];
};

void main() {
    Pixel pixel = this_pixel();
    if (!pixel.inside) return;
    Hit hit = hits[pixel.index];
    uint slot = kNoSlot;
    if (hit.face < kFaceInside) slot = search(hit, kNoSlot);
    if (slot != kNoSlot && rests(pixel, slot)) slot |= kSlotRests;
    slots[pixel.index] = slot;
}
