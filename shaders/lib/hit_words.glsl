// A hit made from its words.
#ifndef VX_HIT_WORDS_GLSL
#define VX_HIT_WORDS_GLSL

#include "shared/gpu_types.h"

Hit hit_of(uint words[kHitWords]) {
    Hit hit;
    hit.cell = ivec3(words[0], words[1], words[2]);
    hit.face = words[3];
    hit.fraction = uintBitsToFloat(uvec3(words[4], words[5], words[6]));
    hit.t = uintBitsToFloat(words[7]);
    hit.material = words[8];
    hit.sphere = words[9];
    return hit;
}

#endif
