// One interface to all sample sequences. A key names a sample; dimensions number the decisions made with it.
// Pair p consists of dimensions 2p and 2p+1, so uses of sample_1d and sample_2d must not share a pair.
#ifndef VX_SEQUENCE_H
#define VX_SEQUENCE_H

#include "halton.h"
#include "rng.h"
#include "sobol.h"

VX_BEGIN

VX_CONST(uint, kSequenceSobol, 0u);
VX_CONST(uint, kSequenceHalton, 1u);
VX_CONST(uint, kSequenceWhite, 2u);

// stream: pixel or path id. index: sample number within the stream. seed: the user's.
struct SampleKey {
    uint stream;
    uint index;
    uint seed;
};

// The key of a sample whose index has 64 bits (low word, high word): every 2^32 samples use a new seed, so
// streams never repeat. With a high word of 0 it is the plain key.
VX_FN SampleKey sample_key(uint stream, uvec2 index, uint seed) {
    SampleKey key;
    key.stream = stream;
    key.index = index.x;
    const uint other_seed = seed ^ pcg_hash(index.y);
    key.seed = index.y == 0u ? seed : other_seed;
    return key;
}

// Point in [0, 1)^2 for a pair of dimensions of a kSequence* id.
VX_FN vec2 sample_2d(uint sequence, SampleKey key, uint dimension_pair) {
    uint d = 2u * dimension_pair;
    if (sequence == kSequenceSobol) {
        uvec2 bits = sobol_pair(key.seed, key.stream, key.index, dimension_pair);
        return vec2(unit_float(bits.x), unit_float(bits.y));
    }
    if (sequence == kSequenceHalton) {
        return vec2(halton_float(key.seed, key.stream, key.index, d),
                    halton_float(key.seed, key.stream, key.index, d + 1u));
    }
    return vec2(rng_float(key.seed, key.stream, key.index, d),
                rng_float(key.seed, key.stream, key.index, d + 1u));
}

// Number in [0, 1) for one dimension: a coordinate of the pair dimension / 2.
VX_FN float sample_1d(uint sequence, SampleKey key, uint dimension) {
    if (sequence == kSequenceHalton) return halton_float(key.seed, key.stream, key.index, dimension);
    if (sequence == kSequenceWhite) return rng_float(key.seed, key.stream, key.index, dimension);
    uvec2 bits = sobol_pair(key.seed, key.stream, key.index, dimension >> 1u);
    return unit_float((dimension & 1u) == 0u ? bits.x : bits.y);
}

VX_END

#endif
