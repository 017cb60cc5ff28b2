// Owen-scrambled Sobol' sequence by hashing: 2-D points in pairs of dimensions, each pair with its own
// shuffle of the index and its own scramble of both coordinates. Source: Burley 2020, "Practical Hash-based
// Owen Scrambling", JCGT 9(4), sections 3 to 5. We differ in the hash inside the scramble: Vegdahl 2021,
// "Building a Better LK Hash" (psychopath.io), which has less correlation between neighbouring streams than
// the constants of the paper. 32-bit integers throughout: the sequence has 2^32 points and nothing rounds.
#ifndef VX_SOBOL_H
#define VX_SOBOL_H

#include "hash.h"
#include "rng.h"

VX_BEGIN

// Keeps the scrambles apart from white noise drawn with the same counters ("sobl" in ASCII).
VX_CONST(uint, kSobolSalt, 0x736F626Cu);

// The second Sobol' dimension of an index, as a fraction of 2^32. Its generator matrix is Pascal's triangle
// modulo 2, a Kronecker power of ((1,1),(0,1)), so it factors into five masked shifts; the first dimension is
// bitfieldReverse(index). Source: Ahmed 2024, "An Implementation Algorithm of 2D Sobol Sequence Fast,
// Elegant, and Compact", EGSR.
VX_FN uint sobol_second(uint index) {
    uint v = bitfieldReverse(index);
    v ^= (v & 0x55555555u) << 1u;
    v ^= (v & 0x33333333u) << 2u;
    v ^= (v & 0x0F0F0F0Fu) << 4u;
    v ^= (v & 0x00FF00FFu) << 8u;
    v ^= (v & 0x0000FFFFu) << 16u;
    return v;
}

// Nested uniform scramble of a 32-bit fraction: every bit flips by a hash of the bits above it. The seed must
// be well mixed. Source: Burley 2020, section 3.1; constants by Vegdahl 2021.
VX_FN uint owen_scramble(uint v, uint seed) {
    v = bitfieldReverse(v);
    v ^= v * 0x3D20ADEAu;
    v += seed;
    v *= (seed >> 16u) | 1u;
    v ^= v * 0x05526C56u;
    v ^= v * 0x53A22864u;
    return bitfieldReverse(v);
}

// The words that scramble one pair of dimensions of one stream: x for the index, y and z for the coordinates.
VX_FN uvec3 sobol_seeds(uint seed, uint stream, uint pair) {
    uvec4 v = pcg4d(uvec4(seed, stream, pair, kSobolSalt));
    return uvec3(pcg_hash(v.y), pcg_hash(v.z), pcg_hash(v.w));
}

// The scrambled point of an index as two fractions of 2^32. Any aligned block of 2^m indices is a
// (0,m,2)-net.
VX_FN uvec2 sobol_pair(uint seed, uint stream, uint index, uint pair) {
    uvec3 seeds = sobol_seeds(seed, stream, pair);
    uint shuffled = owen_scramble(index, seeds.x);
    return uvec2(owen_scramble(bitfieldReverse(shuffled), seeds.y),
                 owen_scramble(sobol_second(shuffled), seeds.z));
}

VX_END

#endif
