// Counter-based white noise: no state, so any thread can draw any number in any order.
#ifndef VX_RNG_H
#define VX_RNG_H

#include "hash.h"

VX_BEGIN

// The upper 24 bits of `bits` as a float in [0, 1): a multiple of 2^-24, never 1, exact on every device.
VX_FN float unit_float(uint bits) {
    return float(bits >> 8u) * 5.9604644775390625e-8f;
}

// Uniform 32-bit word, a pure function of its four counters.
VX_FN uint rng_uint(uint seed, uint stream, uint index, uint dimension) {
    return hash4(seed, stream, index, dimension);
}

// Uniform float in [0, 1), a pure function of its four counters.
VX_FN float rng_float(uint seed, uint stream, uint index, uint dimension) {
    return unit_float(rng_uint(seed, stream, index, dimension));
}

VX_END

#endif
