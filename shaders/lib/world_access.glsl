// The device side of march.h: the world's three arrays and the traversal that reads them.
#ifndef VX_WORLD_ACCESS_GLSL
#define VX_WORLD_ACCESS_GLSL

layout(constant_id = 10) const uint traversal = 0u;

layout(scalar) readonly buffer Roots {
    uint root_cells[];
};
layout(scalar) readonly buffer Nodes {
    uint node_cells[];
};
layout(scalar) readonly buffer Leaves {
    uint leaf_words[];
};

uint load_root(uint i) {
    return root_cells[i];
}
uint load_node(uint i) {
    return node_cells[i];
}
uint load_leaf(uint i) {
    return leaf_words[i];
}

#define VX_WORLD_PARAM
#define VX_WORLD_ARG
#define VX_TRAVERSAL traversal
#include "shared/march.h"

#endif
