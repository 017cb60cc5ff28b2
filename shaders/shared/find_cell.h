// The cell of a structure (world_cell.h) that holds a voxel: the only difference between traversals.
//
// The including file defines VX_WORLD_PARAM, VX_WORLD_ARG, VX_TRAVERSAL (a specialization constant on the
// device, so that only one branch of each choice remains) and load_root(), load_node(), load_leaf().
#ifndef VX_FIND_CELL_H
#define VX_FIND_CELL_H

#include "world_cell.h"

VX_BEGIN

struct MarchCell {
    uint cell;  // state and payload
    int log2;   // edge of the cell in voxels
    uint bits;  // of one distance
};

VX_FN MarchCell cell_of_byte(VX_WORLD_PARAM ivec3 local, ivec3 size) {
    const uint i = grid_index(local, size);
    const uint value = (load_leaf(VX_WORLD_ARG i >> 2u) >> (8u * (i & 3u))) & 0xFFu;
    MarchCell found;
    found.cell = value == 0u ? make_cell(kCellEmpty, 0u) : make_cell(kCellSolid, value - 1u);
    found.log2 = 0;
    found.bits = kNearBits;
    return found;
}

// 16 bits of the leaves.
VX_FN uint load_half_leaf(VX_WORLD_PARAM uint i) {
    return (load_leaf(VX_WORLD_ARG i >> 1u) >> (16u * (i & 1u))) & 0xFFFFu;
}

// The voxel of a mixed brick of edge 2^log2 with a bit mask; its material is fetched for solid ones only.
VX_FN MarchCell cell_of_mask(VX_WORLD_PARAM uint number, ivec3 local, int log2) {
    const ivec3 c = local & ((1 << log2) - 1);
    const uint i = uint(c.x) | (uint(c.y) << uint(log2)) | (uint(c.z) << uint(2 * log2));
    const uint first = number << uint(3 * log2);  // index of its first voxel among those of all mixed bricks
    const bool solid = ((load_node(VX_WORLD_ARG(first + i) >> 5u) >> (i & 31u)) & 1u) != 0u;
    MarchCell found;
    found.cell = make_cell(kCellEmpty, 0u);
    if (solid) found.cell = make_cell(kCellSolid, load_half_leaf(VX_WORLD_ARG first + i));
    found.log2 = 0;
    found.bits = kNearBits;
    return found;
}

VX_FN MarchCell cell_of_leaf(VX_WORLD_PARAM uint number, ivec3 local) {
    MarchCell found;
    found.cell = cell_of_voxel(load_half_leaf(VX_WORLD_ARG number * 64u + child_slot(local & 3)));
    found.log2 = 0;
    found.bits = kNearBits;
    return found;
}

// The coarsest cell of the structure that holds `local` (inside the world of `chunks` chunks) and has no
// children.
VX_FN MarchCell find_cell(VX_WORLD_PARAM ivec3 local, ivec3 chunks) {
    const int log2 = root_log2(VX_TRAVERSAL);
    if (VX_TRAVERSAL == kTraversalDda) return cell_of_byte(VX_WORLD_ARG local, chunks << kChunkLog2);
    MarchCell found;
    found.cell = load_root(VX_WORLD_ARG root_index(local, chunks, log2));
    found.log2 = log2;
    found.bits = kFarBits;
    if (VX_TRAVERSAL == kTraversalBrick4 || VX_TRAVERSAL == kTraversalBrick8) {
        if (cell_state(found.cell) == kCellMixed)
            found = cell_of_mask(VX_WORLD_ARG cell_payload(found.cell), local, log2);
        return found;
    }
    if (has_brick_nodes(VX_TRAVERSAL)) {
        if (cell_state(found.cell) == kCellMixed) {
            const uint slot = child_slot((local >> kBrickLog2) & 3);
            found.cell = load_node(VX_WORLD_ARG cell_payload(found.cell) * 64u + slot);
            found.log2 = kBrickLog2;
            found.bits = VX_TRAVERSAL == kTraversalNaadf ? kNearBits : kFarBits;
            if (cell_state(found.cell) == kCellMixed)
                found = cell_of_leaf(VX_WORLD_ARG cell_payload(found.cell), local);
        }
        return found;
    }
    if (cell_state(found.cell) == kCellMixed)
        found = cell_of_leaf(VX_WORLD_ARG cell_payload(found.cell), local);
    return found;
}

VX_END

#endif
