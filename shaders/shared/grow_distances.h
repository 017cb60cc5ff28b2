// Growing the distances of one level of a structure, cell by cell (aadf.h says how). The including side
// provides what find_cell.h asks for; the level that grows is read from the world as it was before the step.
#ifndef VX_GROW_DISTANCES_H
#define VX_GROW_DISTANCES_H

#include "aadf.h"
#include "find_cell.h"

VX_BEGIN

// Distances of a cell of edge 2^log2 voxels, or kNotEmpty. A level may ask before its children have grown.
VX_FN uint distances_at(VX_WORLD_PARAM ivec3 cell, int log2, ivec3 chunks) {
    const ivec3 local = cell << log2;
    if (is_outside(local, chunks << kChunkLog2)) return kAadfEndless;
    int level = root_log2(VX_TRAVERSAL);
    const ivec3 grid = (chunks << kChunkLog2) >> level;
    uint found = load_root(VX_WORLD_ARG grid_index(local >> level, grid));
    if (cell_state(found) == kCellMixed && level > kBrickLog2 && log2 <= kBrickLog2) {
        found = load_node(VX_WORLD_ARG cell_payload(found) * 64u + child_slot((local >> kBrickLog2) & 3));
        level = kBrickLog2;
    }
    if (cell_state(found) == kCellMixed && level == kBrickLog2 && log2 == 0) {
        found = load_leaf(VX_WORLD_ARG cell_payload(found) * 64u + child_slot(local & 3));
        level = 0;
    }
    if (cell_state(found) != kCellEmpty) return kNotEmpty;
    if (level == log2) return cell_payload(found);
    return inherited_distances(cell_payload(found), cell & ((1 << (level - log2)) - 1), level - log2);
}

// The empty cell `own` at `cell` after one step along an axis, both ways.
VX_FN uint grown_cell(VX_WORLD_PARAM uint own, ivec3 cell, int log2, ivec3 chunks, uint axis, int bound) {
    const ivec3 unit = ivec3(axis == 0u ? 1 : 0, axis == 1u ? 1 : 0, axis == 2u ? 1 : 0);
    const int low = int(distance_towards(own, 2u * axis));
    const int high = int(distance_towards(own, 2u * axis + 1u));
    uint grown = own;
    if (low < bound) {
        const uint other = distances_at(VX_WORLD_ARG cell - unit * (low + 1), log2, chunks);
        grown = with_distance(grown, 2u * axis, joined_distance(own, other, 2u * axis, bound));
    }
    if (high < bound) {
        const uint other = distances_at(VX_WORLD_ARG cell + unit * (high + 1), log2, chunks);
        grown = with_distance(grown, 2u * axis + 1u, joined_distance(own, other, 2u * axis + 1u, bound));
    }
    return grown;
}

VX_END

#endif
