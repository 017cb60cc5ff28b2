// Slots of a table of cells (cell_table.h): their indices, and when they are emptied.
#ifndef VX_CELL_AGE_H
#define VX_CELL_AGE_H

#include "hash.h"
#include "limits.h"
#include "portable.h"

VX_BEGIN

VX_CONST(uint, kNoSlot, 0xFFFFFFFFu);
// Set in the slot of a pixel that takes no samples for the cell now. Slot indices use the other bits.
VX_CONST(uint, kSlotRests, 0x80000000u);

// Whether a slot last touched in frame `touched` is to be emptied in frame `now`, when unseen cells stay for
// `max_age` frames. Frame numbers may wrap.
VX_FN bool is_stale(uint touched, uint now, uint max_age) {
    return now - touched > max_age;
}

// Whether a frame may touch a key: each key has its turn once in kCellTouchPeriod frames, so that few slots
// are written per frame.
VX_FN bool is_touch_due(uvec2 key, uint frame) {
    return ((hash4(key.x, key.y, 0x746F7563u, 0u) ^ frame) & (kCellTouchPeriod - 1u)) == 0u;  // "touc"
}

// Whether a cell that is seen in a frame is touched in it: in its turn, or when it reappears so old that its
// turn could come too late.
VX_FN bool needs_touch(uvec2 key, uint touched, uint frame) {
    return is_touch_due(key, frame) || frame - touched > kCellMinAge - kCellTouchPeriod;
}

VX_END

#endif
