// A hash table of cells that many threads fill at once: open addressing with linear probing, in at most
// kCellProbes slots starting at a cell's home.
//
// Within a pass slots only go from empty to taken, and each is taken by one 64-bit compare-and-swap of its
// whole key. A thread first searches every slot that may hold its key, so it also finds keys that an earlier
// pass stored behind a slot emptied since. Only then it takes the first empty slot. All threads with the same
// key visit the same slots in the same order, and none of those can become empty: the first thread to take a
// slot is seen by all others. So no key is in the table twice. Slots are emptied in passes of their own
// (cell_age.h).
//
// The including file provides, for its table:
//   uvec2 table_key(slot)         the key in a slot; may be stale, but a written key stays
//   uvec2 table_claim(slot, key)  compares the key in a slot with 0 and swaps; returns the old key
// and defines VX_TABLE_PARAM and VX_TABLE_ARG.
#ifndef VX_CELL_TABLE_H
#define VX_CELL_TABLE_H

#include "cell_age.h"
#include "hash.h"
#include "limits.h"
#include "portable.h"

VX_BEGIN

struct FoundSlot {
    uint slot;    // kNoSlot when every slot that may hold the key holds another one
    uint probes;  // keys compared in the search; 0 when the guess was right
    bool claimed;
};

// Where the search for a key starts. `mask` is the number of slots, a power of two, minus one.
VX_FN uint home_slot(uvec2 key, uint mask) {
    return hash4(key.x, key.y, 0x686F6D65u, 0u) & mask;  // "home"
}

// Whether a slot holds a key.
VX_FN bool holds_key(VX_TABLE_PARAM uint slot, uvec2 key) {
    const uvec2 there = table_key(VX_TABLE_ARG slot);
    return there.x == key.x && there.y == key.y;
}

// The slot of a key, claimed for it if the key is not in the table. `guess` is a slot of the table that may
// hold it, or kNoSlot.
VX_FN FoundSlot find_or_claim(VX_TABLE_PARAM uvec2 key, uint mask, uint guess) {
    const uint home = home_slot(key, mask);
    const uint most = min(kCellProbes - 1u, mask) + 1u;
    FoundSlot found;
    found.slot = kNoSlot;
    found.claimed = false;
    // The guess is tried as probe 0, so that a right one costs one comparison and a wrong one needs no loop
    // of its own.
    for (found.probes = guess == kNoSlot ? 1u : 0u; found.probes <= most; ++found.probes) {
        const uint slot = found.probes == 0u ? guess : (home + found.probes - 1u) & mask;
        if (holds_key(VX_TABLE_ARG slot, key)) {
            found.slot = slot;
            return found;
        }
    }
    found.probes = most;
    for (uint i = 0u; i < most; ++i) {
        const uint slot = (home + i) & mask;
        const uvec2 seen = table_key(VX_TABLE_ARG slot);
        found.probes += 1u;
        const bool is_whole = seen.x != 0u && seen.y != 0u;
        if (is_whole && (seen.x != key.x || seen.y != key.y)) continue;
        const uvec2 there = table_claim(VX_TABLE_ARG slot, key);
        const bool was_empty = there.x == 0u && there.y == 0u;
        if (was_empty || (there.x == key.x && there.y == key.y)) {
            found.slot = slot;
            found.claimed = was_empty;
            return found;
        }
    }
    return found;
}

VX_END

#endif
