// The device side of march.h: the world's three arrays.
#ifndef VX_WORLD_ACCESS_GLSL
#define VX_WORLD_ACCESS_GLSL

layout(scalar) readonly buffer Chunks {
    uint chunk_cells[];
};
layout(scalar) readonly buffer Bricks {
    uint brick_cells[];
};
layout(scalar) readonly buffer Voxels {
    uint voxel_words[];
};

uint load_chunk(uint i) {
    return chunk_cells[i];
}
uint load_brick(uint i) {
    return brick_cells[i];
}
uint load_voxel_word(uint i) {
    return voxel_words[i];
}

#define VX_WORLD_PARAM
#define VX_WORLD_ARG
#include "shared/march.h"

#endif
