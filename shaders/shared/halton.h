// Halton sequence with one rotation per stream (Cranley and Patterson 1976, "Randomization of Number
// Theoretic Methods for Multiple Integration", eq. 2.2): the low-discrepancy points of frames 0 to 8191,
// shifted modulo 1. All of it is integer arithmetic on 24-bit fractions, so every device draws the same bits
// and the sum never rounds up to 1 as fract() of a float can.
#ifndef VX_HALTON_H
#define VX_HALTON_H

#include "hash.h"
#include "limits.h"
#include "rng.h"

VX_BEGIN

// Keeps the rotations apart from white noise drawn with the same counters ("halt" in ASCII).
VX_CONST(uint, kHaltonSalt, 0x68616C74u);

// The prime base of a dimension below kHaltonDimensions.
VX_FN uint halton_base(uint dimension) {
    switch (dimension) {
        case 0u:
            return 2u;
        case 1u:
            return 3u;
        case 2u:
            return 5u;
        case 3u:
            return 7u;
        case 4u:
            return 11u;
        case 5u:
            return 13u;
        case 6u:
            return 17u;
        case 7u:
            return 19u;
        case 8u:
            return 23u;
        case 9u:
            return 29u;
        case 10u:
            return 31u;
        default:
            return 37u;
    }
}

// The radical inverse of index <= kHaltonPeriod in `base`, as a fraction of 2^24, rounded down. Digits
// mirrored at the point give mirrored / power with power < 2^19; the quotient is taken 12 bits at a time to
// stay in 32 bits.
VX_FN uint radical_inverse_24(uint index, uint base) {
    uint mirrored = 0u;
    uint power = 1u;
    for (uint digit = 0u; digit < kHaltonDigitsMax && index > 0u; ++digit) {
        uint next = index / base;
        mirrored = mirrored * base + (index - next * base);
        power *= base;
        index = next;
    }
    uint scaled = mirrored << 12u;
    uint high = scaled / power;
    uint low = ((scaled - high * power) << 12u) / power;
    return (high << 12u) | low;
}

// Float in [0, 1) for one dimension; white noise from kHaltonDimensions on. Repeats after kHaltonPeriod
// frames.
VX_FN float halton_float(uint seed, uint stream, uint frame, uint dimension) {
    if (dimension >= kHaltonDimensions) return rng_float(seed, stream, frame, dimension);
    uint point = radical_inverse_24((frame & (kHaltonPeriod - 1u)) + 1u, halton_base(dimension));
    uint rotation = hash4(seed, stream, dimension, kHaltonSalt) >> 8u;
    return unit_float((point + rotation) << 8u);
}

VX_END

#endif
