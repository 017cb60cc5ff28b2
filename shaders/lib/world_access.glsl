// The device side of march.h: the world's three arrays, reached by address because each may be larger than a
// binding, and the traversal that reads them. Include lib/address.glsl before any other file, define VX_PUSH
// before this one as the members of the push block after the world's, and call init_world() at the start of
// main().
#ifndef VX_WORLD_ACCESS_GLSL
#define VX_WORLD_ACCESS_GLSL

#include "lib/constants.glsl"
#include "shared/gpu_types.h"

#ifndef VX_PUSH
#define VX_PUSH
#endif

VX_SPECIALIZED(uint, traversal, 0u);

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer WorldWords {
    uint words[];
};
layout(push_constant, scalar) uniform Push {
    WorldWords roots;
    WorldWords nodes;
    WorldWords leaves;
    VX_PUSH
};

WorldWords root_cells;
WorldWords node_cells;
WorldWords leaf_cells;

// Loads the pointers once, while all invocations are active (see VX_POINTER).
void init_world() {
    root_cells = VX_POINTER(WorldWords, roots);
    node_cells = VX_POINTER(WorldWords, nodes);
    leaf_cells = VX_POINTER(WorldWords, leaves);
}

// The arrays as texels of one word, where the device has room for that. Lavapipe loads texels for eight
// invocations at once, but behind a pointer for one after the other (lab/notes/march.md).
VX_SPECIALIZED(uint, has_world_texels, 0u);

layout(r32ui) readonly uniform uimageBuffer Roots;
layout(r32ui) readonly uniform uimageBuffer Nodes;
layout(r32ui) readonly uniform uimageBuffer Leaves;

// Behind a pointer, lavapipe moves the index arithmetic into the loop over invocations unless it ends in a
// minimum, which makes a march 3 % faster. (A bound below 2^30 words would undo that: addresses would be
// spilled as vectors of 64 bits, and a march would take 1.5 times as long.)
uint bounded(uint i) {
    return min(i, kLastWorldWord);
}
uint load_root(uint i) {
    return has_world_texels != 0u ? imageLoad(Roots, int(i)).x : root_cells.words[bounded(i)];
}
uint load_node(uint i) {
    return has_world_texels != 0u ? imageLoad(Nodes, int(i)).x : node_cells.words[bounded(i)];
}
uint load_leaf(uint i) {
    return has_world_texels != 0u ? imageLoad(Leaves, int(i)).x : leaf_cells.words[bounded(i)];
}

#define VX_WORLD_PARAM
#define VX_WORLD_ARG
#define VX_TRAVERSAL traversal
#include "shared/march.h"

#endif
