#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// Finds equal bricks: each goes to the first slot of a hash table that is free or holds an equal one, and the slot
// keeps the lowest number of its bricks. Slots never become free and bricks never change, so equal bricks meet in one
// slot whatever the order of the invocations, and the table's last state does not depend on it.

#include "lib/address.glsl"
#include "lib/invocation.glsl"

#include "shared/gpu_types.h"
#include "shared/hash.h"

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer LeafWords {
    uint words[];
};
layout(scalar) coherent buffer Table {
    uint slots[];
};
layout(scalar) writeonly buffer Places {
    uint places[];
};
layout(push_constant, scalar) uniform Push {
    LeafWords leaves;
    WorldMatchPush push;
};

const uint kFree = 0xFFFFFFFFu;
const uint kBlockWords = 32u;

LeafWords leaf_cells;

uint leaf_word(uint i) {
    return leaf_cells.words[i];
}

uint hash_of(uint brick) {
    uint hash = 0u;
    for (uint i = 0u; i < kBlockWords; i += 4u) {
        uint first = brick * kBlockWords + i;
        hash ^= hash4(leaf_word(first) ^ hash, leaf_word(first + 1u), leaf_word(first + 2u), leaf_word(first + 3u));
    }
    return hash;
}

bool are_equal(uint a, uint b) {
    for (uint i = 0u; i < kBlockWords; ++i) {
        if (leaf_word(a * kBlockWords + i) != leaf_word(b * kBlockWords + i)) return false;
    }
    return true;
}

void main() {
    leaf_cells = VX_POINTER(LeafWords, leaves);
    uint brick = linear_id();
    if (brick >= push.count) return;
    uint slot = hash_of(brick) & push.slot_mask;
    // The table has twice as many slots as there are bricks, so a free one is always met.
    for (uint probe = 0u; probe <= push.slot_mask; ++probe) {
        uint held = atomicCompSwap(slots[slot], kFree, brick);
        if (held == kFree || held == brick || are_equal(held, brick)) {
            if (held != kFree) atomicMin(slots[slot], brick);
            places[brick] = slot;
            return;
        }
        slot = (slot + 1u) & push.slot_mask;
    }
}
