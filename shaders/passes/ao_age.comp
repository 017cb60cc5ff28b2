#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// Empties the slots of cells that have not been seen for max_age frames. No other pass runs meanwhile, so no
// slot can be claimed while it is being emptied.

#include "lib/address.glsl"

#include "lib/invocation.glsl"

#include "lib/frame_access.glsl"
#include "lib/counters_access.glsl"

#include "shared/cell_age.h"

layout(scalar) uniform AoFrame {
    AoParams ao_frame;
};
layout(scalar) buffer Keys {
    uint64_t keys[];
};
layout(scalar) buffer Samples {
    uint64_t samples[];
};
layout(scalar) writeonly buffer Opens {
    uint64_t opens[];
};
layout(scalar) readonly buffer Touched {
    uint touched[];
};

void main() {
    uint slot = linear_id();
    if (slot > ao_frame.table_mask) return;
    if (keys[slot] == uint64_t(0) || !is_stale(touched[slot], ao_frame.frame, ao_frame.max_age)) return;
    uvec2 dropped = unpack32(samples[slot]);
    count(kWorkAoEvicted, 1u);
    count(kWorkAoDropped, dropped.y == 0u ? dropped.x : 0xFFFFFFFFu);
    keys[slot] = uint64_t(0);
    samples[slot] = uint64_t(0);
    opens[slot] = uint64_t(0);
}
