// Distances of an empty cell packed as find_cell.h reads them, six fields of kFarBits bits, and the step that
// grows them. A box [c - e(-x), c + e(+x)] x ... grows along one axis by looking at the cell just beyond its
// end: if that cell is empty and its own box is at least as wide on the four sides, both boxes join. Rounds
// raise the longest distance allowed from 1 to 3, 7, 15, 31, and each goes over x, y, z in turn, so that
// boxes stay near to cubes; one join takes a box from one bound to the next, where growing by single cells
// (Ulschmid et al., NAADF, CGF 45(2), 2026) takes 31 rounds. Each step reads only the state before it, so the
// result does not depend on the order of the cells.
#ifndef VX_AADF_H
#define VX_AADF_H

#include "world_cell.h"

VX_BEGIN

VX_CONST(uint, kAadfRounds, 5u);                 // bounds 1, 3, 7, 15, 31
VX_CONST(uint, kAadfSteps, 15u);                 // each round along x, y, z
VX_CONST(uint, kAadfEndless, kCellPayloadMask);  // 31 in every direction: what lies outside the world
VX_CONST(uint, kNotEmpty, 0xFFFFFFFFu);          // in place of distances
VX_CONST(uint, kFieldTops, 0x21084210u);         // highest bit of each field
VX_CONST(uint, kFieldOnes, 31u);

VX_FN uint distance_towards(uint distances, uint direction) {
    return (distances >> (kFarBits * direction)) & kFieldOnes;
}

VX_FN int aadf_bound(uint round) {
    return (2 << round) - 1;
}

// Whether `other` is at least `own` in the four directions that are not of `axis`. All fields are compared at
// once: the lower bits by a subtraction that cannot borrow from the next field, then the top bits.
VX_FN bool covers_sides(uint other, uint own, uint axis) {
    const uint low = (other | kFieldTops) - (own & ~kFieldTops);
    const uint not_less = (other & ~own) | (~(other ^ own) & low);
    const uint sides = kFieldTops & ~(0x3FFu << (2u * kFarBits * axis));
    return (not_less & sides) == sides;
}

// Distances in children of a child of an empty parent with these distances. `place` is the child's place in
// the parent, whose edge is 2^log2 children.
VX_FN uint inherited_distances(uint distances, ivec3 place, int log2) {
    const int last = (1 << log2) - 1;
    uint inherited = 0u;
    for (uint axis = 0u; axis < 3u; ++axis) {
        const int behind = axis == 0u ? place.x : (axis == 1u ? place.y : place.z);
        const int low = (int(distance_towards(distances, 2u * axis)) << log2) + behind;
        const int high = (int(distance_towards(distances, 2u * axis + 1u)) << log2) + last - behind;
        inherited |= uint(min(low, kFarMax)) << (2u * kFarBits * axis);
        inherited |= uint(min(high, kFarMax)) << (2u * kFarBits * axis + kFarBits);
    }
    return inherited;
}

// Distance of a cell in `direction` after it looked at `other`, the distances beyond its end (or kNotEmpty).
VX_FN uint joined_distance(uint own, uint other, uint direction, int bound) {
    const int distance = int(distance_towards(own, direction));
    if (distance >= bound || other == kNotEmpty || !covers_sides(other, own, direction >> 1u))
        return uint(distance);
    return uint(min(bound, distance + 1 + int(distance_towards(other, direction))));
}

VX_FN uint with_distance(uint distances, uint direction, uint distance) {
    const uint shift = kFarBits * direction;
    return (distances & ~(kFieldOnes << shift)) | (distance << shift);
}

VX_END

#endif
