// The table of occlusion cells, and how a hit finds its slot. Include lib/address.glsl first, then
// lib/surface.glsl.
#ifndef VX_AO_CELLS_GLSL
#define VX_AO_CELLS_GLSL

#extension GL_EXT_shader_atomic_int64 : require

#include "lib/constants.glsl"
#include "shared/ao_cell.h"

VX_SPECIALIZED(uint, checkerboard, 0u);
VX_SPECIALIZED(uint, has_limit, 0u);

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
    return ao_cell(hit.cell, hit.face, hit.fraction, ao_level(hit.t * ao_frame.cell_width + ao_frame.parallel_width));
}

// Marks a cell as seen in this frame. All writers of a frame write the same number.
void touch(uvec2 key, uint slot, bool is_new) {
    if (slot != kNoSlot && (is_new || needs_touch(key, touched[slot], ao_frame.frame))) touched[slot] = ao_frame.frame;
}

// The slot of a hit's cell, inserted if missing; kNoSlot when the table has no room. `guess` is as in
// find_or_claim.
uint search(Hit hit, uint guess) {
    uvec2 key = ao_cell_key(cell_of(hit));
    FoundSlot found = find_or_claim(key, ao_frame.table_mask, guess);
    count(kWorkAoProbes, found.probes);
    count(kWorkAoSearches, found.probes > 0u ? 1u : 0u);
    count(kWorkAoClaimed, found.claimed ? 1u : 0u);
    count(kFaultAoTableFull, found.slot == kNoSlot ? 1u : 0u);
    touch(key, found.slot, found.claimed);
    return found.slot;
}

// Whether a pixel adds no samples to its cell this time: it is on the other colour of the checkerboard, or
// the cell has reached its sample limit. A cell without samples always gets some. Call it in a pass that adds
// no samples, so that the sample count it reads does not depend on the order of threads.
bool rests(Pixel pixel, uint slot) {
    if (checkerboard == 0u && has_limit == 0u) return false;
    uint64_t taken = samples[slot];
    if (taken == uint64_t(0)) return false;
    bool other_colour = checkerboard != 0u && ((pixel.x + pixel.y + ao_frame.pass_number) & 1u) != 0u;
    return other_colour || (has_limit != 0u && taken >= uint64_t(ao_frame.sample_limit));
}

#endif
