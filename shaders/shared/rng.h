// White noise. Counter-based: no state, so any thread can draw any number in any order. Also as streams,
// which take a fifth of the arithmetic to draw many numbers in a row.
#ifndef VX_RNG_H
#define VX_RNG_H

#include "hash.h"
#include "limits.h"

VX_BEGIN

// The upper 24 bits of `bits` as a float in [0, 1): a multiple of 2^-24, never 1, exact on every device.
VX_FN float unit_float(uint bits) {
    return float(bits >> 8u) * kUnitStep;
}

// The inverse of unit_float(); the lower bits are 0.
VX_FN uint unit_bits(float u) {
    return uint(u * kUnitSteps) << 8u;
}

// Uniform 32-bit word, a pure function of its four counters.
VX_FN uint rng_uint(uint seed, uint stream, uint index, uint dimension) {
    return hash4(seed, stream, index, dimension);
}

// Uniform float in [0, 1), a pure function of its four counters.
VX_FN float rng_float(uint seed, uint stream, uint index, uint dimension) {
    return unit_float(rng_uint(seed, stream, index, dimension));
}

// A stream of numbers. Different increments, which are odd, give different sequences of period 2^32. Source:
// O'Neill 2014, "PCG", section 6.3.4 (RXS-M-XS).
struct NoiseStream {
    uint state;
    uint increment;
};

// The next number of a stream, uniform in [0, 1), and the advanced stream.
VX_FN float stream_float(NoiseStream stream) {
    return unit_float(pcg_output(stream.state));
}

VX_FN NoiseStream stream_after(NoiseStream stream) {
    NoiseStream next;
    next.state = stream.state * 747796405u + stream.increment;
    next.increment = stream.increment;
    return next;
}

VX_END

#endif
