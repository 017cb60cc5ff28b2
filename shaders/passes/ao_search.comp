#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// Finds in the table the slot of each hit's occlusion cell that ao_reproject did not find.

#include "lib/address.glsl"

#include "lib/invocation.glsl"

#include "lib/frame_access.glsl"
#include "lib/counters_access.glsl"

#include "lib/ao_cells.glsl"

layout(scalar) readonly buffer Hits {
    Hit hits[];
};
layout(scalar) readonly buffer Missed {
    AoMissed missed;
    uint missed_pixels[];
};

Pixel pixel_at(uint index) {
    Pixel pixel;
    pixel.x = frame.first_column + index % frame.column_count;
    pixel.y = frame.first_row + index / frame.column_count;
    pixel.index = index;
    pixel.inside = true;
    return pixel;
}

void main() {
    uint i = linear_id();
    if (i >= missed.count) return;
    Pixel pixel = pixel_at(missed_pixels[i]);
    uint slot = search(hits[pixel.index], kNoSlot);
    if (slot != kNoSlot && rests(pixel, slot)) slot |= kSlotRests;
    slots[pixel.index] = slot;
}
