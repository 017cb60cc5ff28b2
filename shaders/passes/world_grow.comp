#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// One step of expanding the empty boxes of one level of the world, a cell per invocation. The level is read
// as it was before the step, through its own pointer, and written to `grown`.

#include "lib/address.glsl"
#include "lib/invocation.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer GrownWords {
    uint words[];
};

#define VX_PUSH GrownWords grown; WorldGrowPush push;
#include "lib/constants.glsl"
#include "lib/world_access.glsl"
#include "shared/grow_distances.h"

// Edge of the level's cells in voxels, as a power of two. A constant, so that only the requested level is
// compiled: software devices run through branches that no invocation takes.
VX_SPECIALIZED(uint, level, 0u);

layout(scalar) readonly buffer Homes {
    ivec3 homes[];
};

void main() {
    init_world();
    GrownWords grown_words = VX_POINTER(GrownWords, grown);
    uint i = linear_id();
    if (i >= push.count) return;
    int log2 = int(level);
    uint own = log2 == root_log2(traversal) ? load_root(i) : load_node(i);
    ivec3 cell = log2 == kChunkLog2 ? grid_cell(i, push.chunks) : child_cell(homes[i >> 6u], i & 63u);
    grown_words.words[i] = grown_word(own, cell, log2, push.chunks, GrowthStep(push.axis, push.bound));
}
