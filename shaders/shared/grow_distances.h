// Expands the boxes of chunks and of bricks, cell by cell (see aadf.h). The including file provides what
// find_cell.h requires; the level being expanded is read as it was before the step. The boxes of voxels are
// built with the bricks and not here.
#ifndef VX_GROW_DISTANCES_H
#define VX_GROW_DISTANCES_H

#include "aadf.h"
#include "find_cell.h"

VX_BEGIN

// Distances of a cell of edge 2^log2 voxels, or kNotEmpty.
VX_FN uint distances_at(VX_WORLD_PARAM ivec3 cell, int log2, ivec3 chunks) {
    const ivec3 local = cell << log2;
    if (is_outside(local, chunks << kChunkLog2)) return kEndless;
    const int root = root_log2(VX_TRAVERSAL);
    uint found = load_root(VX_WORLD_ARG root_index(local, chunks, root));
    bool is_child = false;
    if (root > log2 && cell_state(found) == kCellMixed) {
        found = load_node(VX_WORLD_ARG cell_payload(found) * 64u + child_slot(cell & 3));
        is_child = true;
    }
    if (cell_state(found) != kCellEmpty) return kNotEmpty;
    if (root > log2 && !is_child) return inherited_distances(cell_payload(found), cell & 3);
    return cell_payload(found);
}

// The word of a cell after a step, which expands both ways along one axis. Only empty cells change.
VX_FN uint grown_word(VX_WORLD_PARAM uint own, ivec3 cell, int log2, ivec3 chunks, GrowthStep step) {
    if (cell_state(own) != kCellEmpty) return own;
    const ivec3 unit = ivec3(step.axis == 0u ? 1 : 0, step.axis == 1u ? 1 : 0, step.axis == 2u ? 1 : 0);
    const int low = int(distance_towards(own, 2u * step.axis));
    const int high = int(distance_towards(own, 2u * step.axis + 1u));
    uint grown = own;
    if (low < step.bound) {
        const uint other = distances_at(VX_WORLD_ARG cell - unit * (low + 1), log2, chunks);
        grown = joined_distances(grown, other, 2u * step.axis, step.bound);
    }
    if (high < step.bound) {
        const uint other = distances_at(VX_WORLD_ARG cell + unit * (high + 1), log2, chunks);
        grown = joined_distances(grown, other, 2u * step.axis + 1u, step.bound);
    }
    return grown;
}

VX_END

#endif
