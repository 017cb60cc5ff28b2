// Distances of an empty cell in six fields of kFarBits bits, as find_cell.h reads them, and the step that
// expands them. A box [c - e(-x), c + e(+x)] x ... expands along one axis by the cell just beyond its end: if
// that cell is empty and its own box is at least as wide on the four sides, both boxes join. Rounds raise the
// longest distance allowed from 1 to 3, 7, 15, 31, and each goes over x, y, z in turn, so that boxes stay
// close to cubes. One join takes a box from one bound to the next, where expanding by single cells (Ulschmid
// et al., NAADF, CGF 45(2), 2026) takes 31 rounds. Each step reads only the state before it, so the result
// does not depend on the order of the cells.
#ifndef VX_AADF_H
#define VX_AADF_H

#include "world_cell.h"

VX_BEGIN

VX_CONST(uint, kGrowthSteps, 15u);           // five rounds along x, y, z
VX_CONST(uint, kNotEmpty, 0xFFFFFFFFu);      // in place of distances
VX_CONST(uint, kEndless, kCellPayloadMask);  // 31 in every direction: what lies outside the world
VX_CONST(uint, kDistanceOnes, 31u);          // of one field
VX_CONST(uint, kDistanceTops, 0x21084210u);  // highest bit of each field

struct GrowthStep {
    uint axis;
    int bound;  // longest distance of the round: 1, 3, 7, 15, 31
};

VX_FN GrowthStep growth_step(uint number) {
    GrowthStep step;
    step.axis = number % 3u;
    step.bound = (2 << (number / 3u)) - 1;
    return step;
}

VX_FN uint distance_towards(uint distances, uint direction) {
    return (distances >> (kFarBits * direction)) & kDistanceOnes;
}

// Whether `other` is at least `own` in the four directions across `axis`. All fields are compared at once:
// the lower bits by a subtraction that cannot borrow from the next field, then the top bits.
VX_FN bool covers_sides(uint other, uint own, uint axis) {
    const uint low = (other | kDistanceTops) - (own & ~kDistanceTops);
    const uint not_less = (other & ~own) | (~(other ^ own) & low);
    const uint sides = kDistanceTops & ~(0x3FFu << (2u * kFarBits * axis));
    return (not_less & sides) == sides;
}

// Distances of a brick inside an empty chunk with these distances. `place` is the brick's place in the chunk.
VX_FN uint inherited_distances(uint distances, ivec3 place) {
    uint inherited = 0u;
    for (uint axis = 0u; axis < 3u; ++axis) {
        const int behind = axis == 0u ? place.x : (axis == 1u ? place.y : place.z);
        const int low = int(distance_towards(distances, 2u * axis)) * 4 + behind;
        const int high = int(distance_towards(distances, 2u * axis + 1u)) * 4 + 3 - behind;
        inherited |= min(uint(low), kDistanceOnes) << (2u * kFarBits * axis);
        inherited |= min(uint(high), kDistanceOnes) << (2u * kFarBits * axis + kFarBits);
    }
    return inherited;
}

// Distances `own` after a step: `other` is those of the cell beyond its end in `direction` (or kNotEmpty).
VX_FN uint joined_distances(uint own, uint other, uint direction, int bound) {
    const int distance = int(distance_towards(own, direction));
    if (distance >= bound || other == kNotEmpty || !covers_sides(other, own, direction >> 1u)) return own;
    const int joined = min(bound, distance + 1 + int(distance_towards(other, direction)));
    return own + (uint(joined - distance) << (kFarBits * direction));
}

VX_END

#endif
