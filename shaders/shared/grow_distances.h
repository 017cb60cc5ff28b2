// Growing the distances of one level of a structure, cell by cell (aadf.h says how). The including side
// provides what find_cell.h asks for; the level that grows is read from the world as it was before the step.
#ifndef VX_GROW_DISTANCES_H
#define VX_GROW_DISTANCES_H

#include "aadf.h"
#include "find_cell.h"

VX_BEGIN

VX_FN uint level_bits(int log2) {
    return log2 == 0 ? kNearBits : kFarBits;
}

// Distances of a cell of edge 2^log2 voxels, or kNotEmpty. A level may ask before its children have grown.
VX_FN uint distances_at(VX_WORLD_PARAM ivec3 cell, int log2, ivec3 chunks) {
    const ivec3 local = cell << log2;
    const uint bits = level_bits(log2);
    if (is_outside(local, chunks << kChunkLog2)) return endless_distances(bits);
    int level = root_log2(VX_TRAVERSAL);
    uint found = load_root(VX_WORLD_ARG root_index(local, chunks, level));
    if (cell_state(found) == kCellMixed && level > kBrickLog2 && log2 <= kBrickLog2) {
        found = load_node(VX_WORLD_ARG cell_payload(found) * 64u + child_slot((local >> kBrickLog2) & 3));
        level = kBrickLog2;
    }
    if (cell_state(found) == kCellMixed && level == kBrickLog2 && log2 == 0) {
        found = cell_of_leaf(VX_WORLD_ARG cell_payload(found), local).cell;
        level = 0;
    }
    if (cell_state(found) != kCellEmpty) return kNotEmpty;
    if (level == log2) return cell_payload(found);
    return inherited_distances(cell_payload(found), cell & ((1 << (level - log2)) - 1), level - log2, bits);
}

// Distances `own` of the empty cell at `cell` after a step of growth, which goes both ways along one axis.
VX_FN uint grown_distances(VX_WORLD_PARAM uint own, ivec3 cell, int log2, ivec3 chunks, GrowthStep step) {
    const uint bits = level_bits(log2);
    const uint axis = step.axis;
    const int bound = step.bound;
    const ivec3 unit = ivec3(axis == 0u ? 1 : 0, axis == 1u ? 1 : 0, axis == 2u ? 1 : 0);
    const int low = int(distance_towards(own, 2u * axis, bits));
    const int high = int(distance_towards(own, 2u * axis + 1u, bits));
    uint grown = own;
    if (low < bound) {
        const uint other = distances_at(VX_WORLD_ARG cell - unit * (low + 1), log2, chunks);
        grown = joined_distances(grown, other, 2u * axis, bound, bits);
    }
    if (high < bound) {
        const uint other = distances_at(VX_WORLD_ARG cell + unit * (high + 1), log2, chunks);
        grown = joined_distances(grown, other, 2u * axis + 1u, bound, bits);
    }
    return grown;
}

// A word of the roots or the nodes, the cell at `cell`, after a step of growth.
VX_FN uint grown_word(VX_WORLD_PARAM uint own, ivec3 cell, int log2, ivec3 chunks, GrowthStep step) {
    if (cell_state(own) != kCellEmpty) return own;
    return grown_distances(VX_WORLD_ARG own, cell, log2, chunks, step);
}

// A word of the leaves, two voxels of the block at `home`, after a step of growth. `word` is its number in
// the block.
VX_FN uint grown_leaf_word(VX_WORLD_PARAM uint own, uvec2 home, uint word, ivec3 chunks, GrowthStep step) {
    uint grown = own;
    for (uint lane = 0u; lane < 2u; ++lane) {
        const uint voxel = (own >> (16u * lane)) & 0xFFFFu;
        if ((voxel & kVoxelSolidBit) != 0u) continue;
        const ivec3 cell = home_cell(home, 2u * word + lane);
        const uint distances = grown_distances(VX_WORLD_ARG voxel, cell, 0, chunks, step);
        grown += (distances - voxel) << (16u * lane);
    }
    return grown;
}

VX_END

#endif
