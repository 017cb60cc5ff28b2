// The table of occlusion cells and how a hit finds its slot. Include lib/address.glsl first, and lib/surface.glsl.
#ifndef VX_AO_CELLS_GLSL
#define VX_AO_CELLS_GLSL

#extension GL_EXT_shader_atomic_int64 : require

#include "shared/ao_cell.h"

layout(constant_id = 20) const uint reprojects = 1u;
layout(constant_id = 21) const uint checkerboard = 0u;
layout(constant_id = 22) const uint has_limit = 0u;

layout(scalar) uniform AoFrame {
    AoParams ao_frame;
};
layout(scalar) buffer Keys {
    uint64_t keys[];
};
layout(scalar) buffer Samples {
    uint64_t samples[];
};
layout(scalar) buffer Touched {
    uint touched[];
};
layout(scalar) readonly buffer LastSlots {
    uint last_slots[];
};
layout(scalar) writeonly buffer Slots {
    uint slots[];
};

uvec2 table_key(uint slot) {
    return unpack32(keys[slot]);
}
uvec2 table_claim(uint slot, uvec2 key) {
    count(kWorkAoSwaps, 1u);
    return unpack32(atomicCompSwap(keys[slot], uint64_t(0), pack64(key)));
}

#define VX_TABLE_PARAM
#define VX_TABLE_ARG
#include "shared/cell_table.h"

AoCell cell_of(Hit hit) {
    return ao_cell(hit.cell, hit.face, hit.fraction, ao_level(hit.t * ao_frame.cell_width));
}

// The slot that a pixel of the sample before had, if it is that of `key`.
uint last_slot(ivec2 pixel, uvec2 key) {
    bool inside = pixel.x >= 0 && pixel.y >= 0 && pixel.x < int(frame.column_count) && pixel.y < int(frame.row_count);
    if (!inside) return kNoSlot;
    uint slot = last_slots[uint(pixel.y) * frame.column_count + uint(pixel.x)];
    if (slot == kNoSlot) return kNoSlot;
    slot &= ~kSlotRests;
    return holds_key(slot, key) ? slot : kNoSlot;
}

// The slot of `key` if the sample before had it where it saw the point of a hit: in that pixel, or in the three next
// to it on the nearer sides, because its rays went through other points of their pixels.
uint reproject(Hit hit, uvec2 key) {
    vec3 to_hit = vec3(hit.cell - ao_frame.last_camera_cell) + (hit.fraction - ao_frame.last_camera_fraction);
    float depth = dot(to_hit, ao_frame.last_forward);
    vec2 image = vec2(dot(to_hit, ao_frame.last_right), -dot(to_hit, ao_frame.last_up)) / depth;
    vec2 place = (0.5 * image + 0.5) * vec2(frame.width, frame.height) - vec2(frame.first_column, frame.first_row);
    bool seen = ao_frame.has_last != 0u && depth > 0.0 && place.x > -1.0 && place.y > -1.0 &&
                place.x < float(frame.column_count) + 1.0 && place.y < float(frame.row_count) + 1.0;
    if (!seen) return kNoSlot;
    vec2 corner = floor(place);
    ivec2 nearer = ivec2(place.x - corner.x < 0.5 ? -1 : 1, place.y - corner.y < 0.5 ? -1 : 1);
    uint slot = kNoSlot;
    for (int i = 0; i < 4 && slot == kNoSlot; ++i)
        slot = last_slot(ivec2(corner) + ivec2((i & 1) * nearer.x, (i >> 1) * nearer.y), key);
    return slot;
}

// The slot of a hit's cell, by reprojection or by a search, entered and touched as needed; kNoSlot when the table has
// no room.
uint locate(Hit hit) {
    uvec2 key = ao_cell_key(cell_of(hit));
    uint guess = kNoSlot;
    if (reprojects != 0u) guess = reproject(hit, key);
    FoundSlot found = find_or_claim(key, ao_frame.table_mask, guess);
    count(kWorkAoProbes, found.probes);
    count(kWorkAoReused, found.probes == 0u ? 1u : 0u);
    count(kWorkAoSearches, found.probes > 0u ? 1u : 0u);
    count(kWorkAoClaimed, found.claimed ? 1u : 0u);
    count(kFaultAoTableFull, found.slot == kNoSlot ? 1u : 0u);
    // All writers of a frame write the same number.
    if (found.slot != kNoSlot && (found.claimed || needs_touch(key, touched[found.slot], ao_frame.frame)))
        touched[found.slot] = ao_frame.frame;
    return found.slot;
}

// Whether a pixel leaves a cell alone this time: on the other colour of the checkerboard, or when the cell has had
// enough. A cell without samples is never left alone. Call it in a pass that adds no samples: it must see the same
// number whatever the order of the threads.
bool rests(Pixel pixel, uint slot) {
    if (checkerboard == 0u && has_limit == 0u) return false;
    uint64_t taken = samples[slot];
    if (taken == uint64_t(0)) return false;
    bool other_colour = checkerboard != 0u && ((pixel.x + pixel.y + ao_frame.pass_number) & 1u) != 0u;
    return other_colour || (has_limit != 0u && taken >= uint64_t(ao_frame.sample_limit));
}

#endif
