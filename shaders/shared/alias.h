// Draws from a list in proportion to power, in constant time: an alias table. The host builds it
// (engine/scene/alias_table.h). Source: Walker 1977, "An Efficient Method for Generating Discrete Random
// Variables with General Distributions", ACM TOMS 3(3).
#ifndef VX_ALIAS_H
#define VX_ALIAS_H

#include "portable.h"

VX_BEGIN

// Bucket i of n. A draw takes one of the n buckets with equal probability, and from it i or `other`.
struct AliasEntry {
    float keep;  // probability of i once its bucket is drawn: a multiple of 2^-24 in [0, 1]
    uint other;  // drawn otherwise
    float pdf;   // probability that a draw gives i, over all buckets
};
VX_CONST(uint, kAliasWords, 3u);

// floor(bits n / 2^32): an index below n, all equally likely to within 2^-32. Computed in halves, because
// 64-bit products are not available everywhere.
VX_FN uint alias_bucket(uint bits, uint n) {
    uint low = (bits & 0xFFFFu) * (n & 0xFFFFu);
    uint middle = (bits >> 16u) * (n & 0xFFFFu) + (low >> 16u);
    uint carried = (bits & 0xFFFFu) * (n >> 16u) + (middle & 0xFFFFu);
    return (bits >> 16u) * (n >> 16u) + (middle >> 16u) + (carried >> 16u);
}

// What `bucket` gives for u in [0, 1), a multiple of 2^-24.
VX_FN uint alias_choice(AliasEntry entry, uint bucket, float u) {
    return u < entry.keep ? bucket : entry.other;
}

VX_END

#endif
