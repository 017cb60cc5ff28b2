#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// One step of growing the boxes of one level of the world: each empty cell along one axis, both ways. The level is
// read as it was before the step, through its own block, and written to Grown.

#include "lib/invocation.glsl"

#include "lib/world_access.glsl"
#include "shared/gpu_types.h"
#include "shared/grow_distances.h"

layout(scalar) readonly buffer Homes {
    uint homes[];
};
layout(scalar) writeonly buffer Grown {
    uint grown_cells[];
};
layout(push_constant, scalar) uniform Push {
    WorldGrowPush push;
};

void main() {
    uint i = linear_id();
    if (i >= push.count) return;
    bool is_root = int(push.log2) == root_log2(traversal);
    uint own = 0u;
    if (is_root) own = load_root(i);
    if (!is_root && push.log2 == uint(kBrickLog2)) own = load_node(i);
    if (!is_root && push.log2 == 0u) own = load_leaf(i);
    uint grown = own;
    if (cell_state(own) == kCellEmpty) {
        ivec3 cell = is_root ? grid_cell(i, (push.chunks << kChunkLog2) >> int(push.log2))
                             : home_cell(homes[i >> 6u], i & 63u, int(push.log2), push.chunks);
        grown = grown_cell(own, cell, int(push.log2), push.chunks, push.axis, push.bound);
    }
    grown_cells[i] = grown;
}
