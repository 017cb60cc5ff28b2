// Photons in device buffers, two words at a time: lavapipe loads for one invocation after the other. A stored
// photon has four pairs: the three of SortedPhoton, then bucket and rank. Include lib/address.glsl first.
#ifndef VX_PHOTON_WORDS_GLSL
#define VX_PHOTON_WORDS_GLSL

#include "shared/photon_types.h"

SortedPhoton photon_of_words(uint64_t a, uint64_t b, uint64_t c) {
    uvec2 xy = unpack32(a);
    uvec2 zs = unpack32(b);
    SortedPhoton photon;
    photon.position = uintBitsToFloat(uvec3(xy, zs.x));
    photon.surface = zs.y;
    photon.power = unpack32(c);
    return photon;
}

#endif
