// Distances of an empty cell, packed in six fields of kFarBits or kNearBits bits as find_cell.h reads them,
// and the step that grows them. A box [c - e(-x), c + e(+x)] x ... grows along one axis by looking at the
// cell just beyond its end: if that cell is empty and its own box is at least as wide on the four sides, both
// boxes join. Rounds raise the longest distance allowed from 1 to 3, 7, 15, 31, and each goes over x, y, z in
// turn, so that boxes stay near to cubes; one join takes a box from one bound to the next, where growing by
// single cells (Ulschmid et al., NAADF, CGF 45(2), 2026) takes 31 rounds. Each step reads only the state
// before it, so the result does not depend on the order of the cells.
#ifndef VX_AADF_H
#define VX_AADF_H

#include "world_cell.h"

VX_BEGIN

VX_CONST(uint, kNotEmpty, 0xFFFFFFFFu);  // in place of distances

// Steps that grow distances of so many bits: each round along x, y, z.
VX_FN uint growth_steps(uint bits) {
    return 3u * bits;
}

struct GrowthStep {
    uint axis;
    int bound;  // longest distance of the round: 1, 3, 7, ...
};

VX_FN GrowthStep growth_step(uint number) {
    GrowthStep step;
    step.axis = number % 3u;
    step.bound = (2 << (number / 3u)) - 1;
    return step;
}

VX_FN uint distance_ones(uint bits) {
    return (1u << bits) - 1u;
}

// Highest bit of each of the six fields.
VX_FN uint distance_tops(uint bits) {
    return bits == kFarBits ? 0x21084210u : 0xAAAu;
}

// The longest distance in every direction: what lies outside the world.
VX_FN uint endless_distances(uint bits) {
    return (1u << (6u * bits)) - 1u;
}

VX_FN uint distance_towards(uint distances, uint direction, uint bits) {
    return (distances >> (bits * direction)) & distance_ones(bits);
}

// Whether `other` is at least `own` in the four directions that are not of `axis`. All fields are compared at
// once: the lower bits by a subtraction that cannot borrow from the next field, then the top bits.
VX_FN bool covers_sides(uint other, uint own, uint axis, uint bits) {
    const uint tops = distance_tops(bits);
    const uint low = (other | tops) - (own & ~tops);
    const uint not_less = (other & ~own) | (~(other ^ own) & low);
    const uint sides = tops & ~(((1u << (2u * bits)) - 1u) << (2u * bits * axis));
    return (not_less & sides) == sides;
}

// Distances, in fields of `bits`, of a cell inside an empty cell with distances of kFarBits. `place` is its
// place there; the larger cell's edge is 2^log2 of the smaller.
VX_FN uint inherited_distances(uint distances, ivec3 place, int log2, uint bits) {
    const int last = (1 << log2) - 1;
    const int most = int(distance_ones(bits));
    uint inherited = 0u;
    for (uint axis = 0u; axis < 3u; ++axis) {
        const int behind = axis == 0u ? place.x : (axis == 1u ? place.y : place.z);
        const int low = (int(distance_towards(distances, 2u * axis, kFarBits)) << log2) + behind;
        const int high = (int(distance_towards(distances, 2u * axis + 1u, kFarBits)) << log2) + last - behind;
        inherited |= uint(min(low, most)) << (2u * bits * axis);
        inherited |= uint(min(high, most)) << (2u * bits * axis + bits);
    }
    return inherited;
}

// Distances `own` after the cell looked at `other`, those beyond its end in `direction` (or kNotEmpty).
VX_FN uint joined_distances(uint own, uint other, uint direction, int bound, uint bits) {
    const int distance = int(distance_towards(own, direction, bits));
    if (distance >= bound || other == kNotEmpty || !covers_sides(other, own, direction >> 1u, bits))
        return own;
    const int joined = min(bound, distance + 1 + int(distance_towards(other, direction, bits)));
    return own + (uint(joined - distance) << (bits * direction));
}

VX_END

#endif
