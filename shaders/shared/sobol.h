// Owen-scrambled Sobol' sequence by hashing: 2-D points in pairs of dimensions. Three pairs form a group with
// one shuffle of the index, and each coordinate has its own scramble. Source: Burley 2020, "Practical
// Hash-based Owen Scrambling", JCGT 9(4), sections 3 to 5. We differ in two things. The hash inside the
// scramble is Vegdahl's of 2021, "Building a Better LK Hash" (psychopath.io), which has less correlation
// between neighbouring streams than the constants of the paper. And the later pairs of a group are not
// further Sobol' dimensions but the first two in another order (sobol_reorder), so that each pair alone is as
// even as two dimensions can be, and the pairs together are even, too: occlusion and the position in the
// pixel are one 4-D integral. 32-bit integers throughout: the sequence has 2^32 points and nothing rounds.
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

VX_CONST(uint, kSobolGroup, 3u);       // pairs
VX_CONST(uint, kSobolOrderBits, 14u);  // of the index that take part in an order: 16384 samples
// Columns of two unitriangular matrices over GF(2), lowest bit first. Found by a beam search, column by
// column, that minimized the t-values of the first 2^m points, m to 14, of the group's first four dimensions,
// then of all six. A test checks the result: t = 3 for the first 1024 points of the first two pairs.
VX_CONST_LIST(uint, kSobolOrder, 28) = {
    0x0001u, 0x0002u, 0x0005u, 0x000Bu, 0x0010u, 0x0021u, 0x0043u, 0x00FEu, 0x015Bu, 0x0211u,
    0x0402u, 0x0827u, 0x199Fu, 0x3D93u, 0x0001u, 0x0003u, 0x0004u, 0x000Au, 0x0017u, 0x0038u,
    0x0041u, 0x00F6u, 0x015Au, 0x0251u, 0x0522u, 0x0DF5u, 0x1F3Fu, 0x2FD5u,
};

// The index at which a pair of a group takes its point: a bijection that maps aligned blocks of 2^m indices
// to themselves, so each stays a net. place: 0 to 2.
VX_FN uint sobol_reorder(uint index, uint place) {
    if (place == 0u) return index;
    uint order = (index >> kSobolOrderBits) << kSobolOrderBits;
    for (uint bit = 0u; bit < kSobolOrderBits; ++bit) {
        if (((index >> bit) & 1u) != 0u) order ^= kSobolOrder[(place - 1u) * kSobolOrderBits + bit];
    }
    return order;
}

// The words that scramble one pair of dimensions of one stream: y and z for its coordinates; x shuffles the
// index and belongs to the group with that number.
VX_FN uvec3 sobol_seeds(uint seed, uint stream, uint pair) {
    uvec4 v = pcg4d(uvec4(seed, stream, pair, kSobolSalt));
    return uvec3(pcg_hash(v.y), pcg_hash(v.z), pcg_hash(v.w));
}

// The scrambled point of an index as two fractions of 2^32. Any aligned block of 2^m indices is a
// (0,m,2)-net.
VX_FN uvec2 sobol_pair(uint seed, uint stream, uint index, uint pair) {
    uint group = pair / kSobolGroup;
    uint place = pair - group * kSobolGroup;
    uvec3 seeds = sobol_seeds(seed, stream, pair);
    uint shuffled = sobol_reorder(owen_scramble(index, sobol_seeds(seed, stream, group).x), place);
    return uvec2(owen_scramble(bitfieldReverse(shuffled), seeds.y),
                 owen_scramble(sobol_second(shuffled), seeds.z));
}

VX_END

#endif
