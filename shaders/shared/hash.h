// Integer hashes that generate all randomness: pure functions of 32-bit words, the same bits on every device.
#ifndef VX_HASH_H
#define VX_HASH_H

#include "portable.h"

VX_BEGIN

// The output permutation RXS-M-XS of 32 bits, a bijection. Source: O'Neill 2014, "PCG", section 6.3.4.
VX_FN uint pcg_output(uint state) {
    uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

// One round of a linear congruential step and that permutation, as a hash: a bijection of 32-bit words.
// Source: Jarzynski and Olano 2020, "Hash Functions for GPU Rendering", JCGT 9(3), listing of pcg.
VX_FN uint pcg_hash(uint v) {
    return pcg_output(v * 747796405u + 2891336453u);
}

// Three words to three: a bijection. Differences in the high bits of the input reach only part of the output,
// so apply pcg_hash to the result where every bit matters. Source: Jarzynski and Olano 2020, pcg3d.
VX_FN uvec3 pcg3d(uvec3 v) {
    v = v * 1664525u + 1013904223u;
    for (int pass = 0; pass < 2; ++pass) {
        v.x += v.y * v.z;
        v.y += v.z * v.x;
        v.z += v.x * v.y;
        if (pass == 0) v = uvec3(v.x ^ (v.x >> 16u), v.y ^ (v.y >> 16u), v.z ^ (v.z >> 16u));
    }
    return v;
}

// Four words to four: a bijection, with the weakness of pcg3d. Source: Jarzynski and Olano 2020, pcg4d.
VX_FN uvec4 pcg4d(uvec4 v) {
    v = v * 1664525u + 1013904223u;
    for (int pass = 0; pass < 2; ++pass) {
        v.x += v.y * v.w;
        v.y += v.z * v.x;
        v.z += v.x * v.y;
        v.w += v.y * v.z;
        if (pass == 0)
            v = uvec4(v.x ^ (v.x >> 16u), v.y ^ (v.y >> 16u), v.z ^ (v.z >> 16u), v.w ^ (v.w >> 16u));
    }
    return v;
}

// One well mixed word from four: each input bit flips each output bit with probability one half, as far as
// 16384 trials can tell. It is the last word that pcg4d computes; the first is biased by up to 0.13.
VX_FN uint hash4(uint a, uint b, uint c, uint d) {
    return pcg_hash(pcg4d(uvec4(a, b, c, d)).w);
}

VX_END

#endif
