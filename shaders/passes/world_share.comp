#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// Lets each mixed brick point to the first of those that are equal to it.

#include "lib/address.glsl"
#include "lib/invocation.glsl"

#include "shared/gpu_types.h"
#include "shared/world_cell.h"

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer CellWords {
    uint words[];
};
layout(scalar) readonly buffer Table {
    uint slots[];
};
layout(scalar) readonly buffer Places {
    uint places[];
};
layout(push_constant, scalar) uniform Push {
    CellWords cells;
    WorldSharePush push;
};

void main() {
    CellWords all = VX_POINTER(CellWords, cells);
    uint i = linear_id();
    if (i >= push.count) return;
    uint cell = all.words[i];
    if (cell_state(cell) == kCellMixed) all.words[i] = make_cell(kCellMixed, slots[places[cell_payload(cell)]]);
}
