// Bit layouts of the structures that a ray may be marched through. All describe one grid of voxels, grouped
// in bricks of 4^3 and chunks of 16^3, in three arrays of words: roots (a dense grid), nodes, leaves. A
// traversal uses those it needs:
//
//   name    roots                   nodes                   leaves
//   dda     -                       -                       byte per voxel: 0 empty, else material + 1
//   brick4  cells of 4^3, no boxes  64-bit mask per brick   16-bit material per voxel of mixed bricks
//   brick8  cells of 8^3, no boxes  512-bit mask per brick  the same
//   naadf   chunks, boxes <= 31     bricks, boxes <= 3      16 bits per voxel, boxes <= 3
//                                   within the chunk        within the brick
//   deep    chunks, boxes <= 31     bricks, boxes <= 31     16 bits per voxel, boxes <= 3
//   wide    bricks, boxes <= 31     -                       as deep
//
// A cell is empty, filled with one material, or mixed (it has children). An empty cell with a box stores how
// many further cells of its own size are empty in each of the directions -x +x -y +y -z +z: the box they span
// is free of voxels. (Anisotropic distances, nested: Ulschmid et al., NAADF, CGF 45(2), 2026,
// doi 10.1111/cgf.70413. There the boxes of bricks and voxels stay inside their parent, 0 to 3.)
#ifndef VX_WORLD_CELL_H
#define VX_WORLD_CELL_H

#include "portable.h"

VX_BEGIN

VX_CONST(uint, kTraversalDda, 0u);
VX_CONST(uint, kTraversalBrick4, 1u);
VX_CONST(uint, kTraversalBrick8, 2u);
VX_CONST(uint, kTraversalNaadf, 3u);
VX_CONST(uint, kTraversalDeep, 4u);
VX_CONST(uint, kTraversalWide, 5u);
VX_CONST(uint, kTraversalCount, 6u);

VX_CONST(uint, kCellEmpty, 0u);
VX_CONST(uint, kCellSolid, 1u);
VX_CONST(uint, kCellMixed, 2u);

VX_CONST(uint, kCellStateShift, 30u);
VX_CONST(uint, kCellPayloadMask, 0x3FFFFFFFu);

VX_CONST(int, kBrickLog2, 2);  // a brick is 4^3 voxels
VX_CONST(int, kChunkLog2, 4);  // a chunk is 16^3 voxels

VX_CONST(uint, kFarBits, 5u);   // of a distance of roots and nodes
VX_CONST(uint, kNearBits, 2u);  // of a distance of voxels, and of bricks that stay inside their chunk

VX_CONST(uint, kVoxelSolidBit, 0x8000u);  // of the 16 bits of a voxel; the others hold material or distances
VX_CONST(uint, kVoxelPayloadMask, 0x7FFFu);  // 32,768 materials
VX_CONST(uint, kByteMaterials, 255u);        // materials that a byte per voxel can tell apart

VX_FN uint cell_state(uint cell) {
    return cell >> kCellStateShift;
}

VX_FN uint cell_payload(uint cell) {
    return cell & kCellPayloadMask;
}

VX_FN uint make_cell(uint state, uint payload) {
    return (state << kCellStateShift) | payload;
}

// The common form of a voxel's 16 bits, so that one march serves all levels.
VX_FN uint cell_of_voxel(uint voxel) {
    const uint state = (voxel & kVoxelSolidBit) != 0u ? kCellSolid : kCellEmpty;
    return make_cell(state, voxel & kVoxelPayloadMask);
}

// Position of a child inside its parent of 4^3 children; `local` components are in [0,3].
VX_FN uint child_slot(ivec3 local) {
    return uint(local.x + 4 * local.y + 16 * local.z);
}

// Edge of a root cell in voxels.
VX_FN int root_log2(uint traversal) {
    if (traversal == kTraversalDda) return 0;
    if (traversal == kTraversalBrick8) return 3;
    return traversal == kTraversalBrick4 || traversal == kTraversalWide ? kBrickLog2 : kChunkLog2;
}

// Whether bricks are the children of chunks.
VX_FN bool has_brick_nodes(uint traversal) {
    return traversal == kTraversalNaadf || traversal == kTraversalDeep;
}

// Whether boxes may leave their parent on every level.
VX_FN bool has_free_boxes(uint traversal) {
    return traversal == kTraversalDeep || traversal == kTraversalWide;
}

VX_FN bool is_outside(ivec3 local, ivec3 size) {
    return uint(local.x) >= uint(size.x) || uint(local.y) >= uint(size.y) || uint(local.z) >= uint(size.z);
}

// Index of a root cell in a grid of `size` cells.
VX_FN uint grid_index(ivec3 cell, ivec3 size) {
    return uint(cell.x) + uint(size.x) * (uint(cell.y) + uint(size.y) * uint(cell.z));
}

// Index of the root word that holds the cell of `local`. Bricks are in the order of their chunks, 64
// together, so that a ray stays in few cache lines.
VX_FN uint root_index(ivec3 local, ivec3 chunks, int log2) {
    if (log2 == kBrickLog2)
        return grid_index(local >> kChunkLog2, chunks) * 64u + child_slot((local >> kBrickLog2) & 3);
    return grid_index(local >> log2, (chunks << kChunkLog2) >> log2);
}

// Cell of a grid by its index.
VX_FN ivec3 grid_cell(uint index, ivec3 size) {
    const int row = int(index / uint(size.x));
    return ivec3(int(index % uint(size.x)), row % size.y, row / size.y);
}

// Position of a child in its parent.
VX_FN ivec3 slot_cell(uint slot) {
    return ivec3(int(slot & 3u), int((slot >> 2u) & 3u), int(slot >> 4u));
}

// The child `slot` of the cell `parent`, in cells of the child's size.
VX_FN ivec3 child_cell(ivec3 parent, uint slot) {
    return parent * 4 + slot_cell(slot);
}

VX_END

#endif
