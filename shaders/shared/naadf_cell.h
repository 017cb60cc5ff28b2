// Bit layout of nested anisotropic distance fields (NAADF; Ulschmid et al., CGF 45(2), 2026,
// doi 10.1111/cgf.70413). Three levels: chunks of 16^3 voxels in a dense grid, bricks of 4^3 voxels (64 to a
// chunk), voxels (64 to a brick). Every cell is empty, filled with one material, or mixed (it has children).
// An empty cell stores how many further cells of its own level are empty in each of the six directions -x +x
// -y +y -z +z: the box they span is free of voxels. Chunk distances may reach 31 chunks; brick and voxel
// distances stay inside their parent (0 to 3).
#ifndef VX_NAADF_CELL_H
#define VX_NAADF_CELL_H

#include "portable.h"

VX_BEGIN

VX_CONST(uint, kCellEmpty, 0u);
VX_CONST(uint, kCellSolid, 1u);
VX_CONST(uint, kCellMixed, 2u);

VX_CONST(uint, kCellStateShift, 30u);
VX_CONST(uint, kCellPayloadMask, 0x3FFFFFFFu);

VX_CONST(int, kBrickLog2, 2);  // a brick is 4^3 voxels
VX_CONST(int, kChunkLog2, 4);  // a chunk is 16^3 voxels

VX_CONST(uint, kChunkDistanceBits, 5u);
VX_CONST(uint, kInnerDistanceBits, 2u);  // bricks and voxels
VX_CONST(int, kChunkDistanceMax, 31);
VX_CONST(int, kInnerDistanceMax, 3);

VX_CONST(uint, kVoxelSolidBit, 0x8000u);  // of the 16 bits of a voxel; the others hold material or distances
VX_CONST(uint, kVoxelPayloadMask, 0x7FFFu);  // 32,768 materials

VX_FN uint cell_state(uint cell) {
    return cell >> kCellStateShift;
}

VX_FN uint cell_payload(uint cell) {
    return cell & kCellPayloadMask;
}

VX_FN uint make_cell(uint state, uint payload) {
    return (state << kCellStateShift) | payload;
}

// The common form of a voxel's 16 bits, so that one march serves all three levels.
VX_FN uint cell_of_voxel(uint voxel) {
    const uint state = (voxel & kVoxelSolidBit) != 0u ? kCellSolid : kCellEmpty;
    return make_cell(state, voxel & kVoxelPayloadMask);
}

// Position of a child inside its parent of 4^3 children; `local` components are in [0,3].
VX_FN uint child_slot(ivec3 local) {
    return uint(local.x + 4 * local.y + 16 * local.z);
}

VX_END

#endif
