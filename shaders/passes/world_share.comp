#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// Lets each mixed brick point to the first of those that are equal to it.

#include "lib/invocation.glsl"

#include "shared/gpu_types.h"
#include "shared/world_cell.h"

layout(scalar) readonly buffer Table {
    uint slots[];
};
layout(scalar) readonly buffer Places {
    uint places[];
};
layout(scalar) buffer Cells {
    uint cells[];
};
layout(push_constant, scalar) uniform Push {
    WorldSharePush push;
};

void main() {
    uint i = linear_id();
    if (i >= push.count) return;
    uint cell = cells[i];
    if (cell_state(cell) == kCellMixed) cells[i] = make_cell(kCellMixed, slots[places[cell_payload(cell)]]);
}
