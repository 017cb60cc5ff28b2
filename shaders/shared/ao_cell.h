// Cells of the ambient occlusion hash: square parts of voxel faces that share their samples.
//
// A cell of level k is 2^-k voxels wide, so it lies within one face of one voxel: all of it is surface, it
// has one normal, and no wall can stand on it. Light does not leak between the two sides of a thin wall, and
// every sample of the cell may start at a point of the cell that depends on the sample's index alone. The
// sums of a cell therefore depend on how many samples it has, not on which pixels or threads took them. Cells
// keyed by position, size and normal: Gautron 2020, "Real-time ray-traced ambient occlusion of complex scenes
// using spatial hashing", SIGGRAPH Talks; levels by distance as there, with a largest and a smallest one.
#ifndef VX_AO_CELL_H
#define VX_AO_CELL_H

#include "gpu_types.h"
#include "hash.h"
#include "limits.h"
#include "portable.h"

VX_BEGIN

struct AoCell {
    ivec3 voxel;  // local to the world, each component below kAoMaxEdge
    uint face;    // 0..5
    uint level;   // 0..kAoLevels-1: the cell is 2^-level voxels wide
    uvec2 part;   // position on the face in cells, along the axes of on_face()
};

// A point of a face: its coordinates along the two axes that follow the normal's in cyclic order.
VX_FN vec2 on_face(uint face, vec3 point) {
    const uint axis = face >> 1u;
    return vec2(axis == 0u ? point.y : (axis == 1u ? point.z : point.x),
                axis == 0u ? point.z : (axis == 1u ? point.x : point.y));
}

// The point of the unit voxel at such coordinates of a face.
VX_FN vec3 off_face(uint face, vec2 place) {
    const uint axis = face >> 1u;
    const float height = float(face & 1u);
    return vec3(axis == 0u ? height : (axis == 1u ? place.y : place.x),
                axis == 0u ? place.x : (axis == 1u ? height : place.y),
                axis == 0u ? place.y : (axis == 1u ? place.x : height));
}

// Level of cells whose wanted width is `width` voxels: the largest that is not wider, within the bounds of
// levels. The comparisons are exact; no logarithm rounds. (There is one for each of the kAoLevels - 1
// borders, because a loop would cost software devices more.)
VX_FN uint ao_level(float width) {
    return (width < 1.0f ? 1u : 0u) + (width < 0.5f ? 1u : 0u) + (width < 0.25f ? 1u : 0u) +
           (width < 0.125f ? 1u : 0u);
}

// The cell around a point of a face: `fraction` in [0,1]^3 of the voxel. Exact: it scales by a power of two.
VX_FN AoCell ao_cell(ivec3 voxel, uint face, vec3 fraction, uint level) {
    const uint parts = 1u << level;
    const vec2 place = on_face(face, fraction) * float(parts);
    AoCell cell;
    cell.voxel = voxel;
    cell.face = face;
    cell.level = level;
    cell.part = uvec2(min(uint(place.x), parts - 1u), min(uint(place.y), parts - 1u));
    return cell;
}

// The point at `u` in [0,1]^2 of a cell, as a fraction of the voxel.
VX_FN vec3 ao_cell_point(AoCell cell, vec2 u) {
    return off_face(cell.face, (vec2(float(cell.part.x), float(cell.part.y)) + u) / float(1u << cell.level));
}

// The cell as 64 bits, low word first: equal keys are equal cells. The top bit of both words is set, so that
// a half-written key is never valid, and 0 means none.
//   low: x (17), low bits of y (14); high: high bits of y (3), z (17), face and part (11)
VX_FN uvec2 ao_cell_key(AoCell cell) {
    const uint first = ((1u << (2u * cell.level)) - 1u) / 3u;  // parts of all coarser levels
    const uint place = cell.face * kAoFaceParts + first + cell.part.x + (cell.part.y << cell.level);
    const uint y = uint(cell.voxel.y);
    return uvec2(0x80000000u | ((y & 0x3FFFu) << 17u) | uint(cell.voxel.x),
                 0x80000000u | (place << 20u) | (uint(cell.voxel.z) << 3u) | (y >> 14u));
}

// Random stream of a cell's samples.
VX_FN uint ao_cell_stream(uvec2 key) {
    return hash4(key.x, key.y, 0x73747265u, 0u);  // "stre"
}

VX_END

#endif
