// Hits of a plane, word by word: lavapipe loads a texel for eight invocations at once, but the words of a
// block for one invocation after the other (lab/notes/film.md). Words that are not used are not loaded.
#ifndef VX_HITS_GLSL
#define VX_HITS_GLSL

#include "lib/hit_words.glsl"

layout(r32ui) readonly uniform uimageBuffer Hits;

Hit load_hit(uint i) {
    uint words[kHitWords];
    for (uint k = 0u; k < kHitWords; ++k)
        words[k] = imageLoad(Hits, int(kHitWords * i + k)).x;
    return hit_of(words);
}

#endif
