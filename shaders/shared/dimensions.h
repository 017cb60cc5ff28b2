// The register of a sample's dimensions: no two decisions share random numbers by accident, and an effect
// that is added or removed leaves the numbers of the others unchanged.
#ifndef VX_DIMENSIONS_H
#define VX_DIMENSIONS_H

#include "hash.h"
#include "portable.h"
#include "rng.h"
#include "sequence.h"

VX_BEGIN

// Pairs of dimensions of the sample sequence (sequence.h). The first dimensions of every sequence are the
// best, so the sky's light on surfaces, which is the noisiest, comes first: occlusion rays or paths.
VX_CONST(uint, kPairOcclusion, 0u);
VX_CONST(uint, kPairPath, kPairOcclusion);  // the first direction of a path
VX_CONST(uint, kPairPixel, 1u);
VX_CONST(uint, kPairSun, 2u);
VX_CONST(uint, kPairEmitter, 3u);       // which emitter
VX_CONST(uint, kPairEmitterPoint, 4u);  // which point of it
VX_CONST(uint, kPairSurface, 5u);       // direction of a diffuse reflection
VX_CONST(uint, kPairPhoton, 6u);        // three pairs, for the emission of a photon
VX_CONST(uint, kPairLens, 9u);          // which point of the camera's aperture
VX_CONST(uint, kPairBounce, 16u);       // kPairsOfBounce for each surface that a path hits
VX_CONST(uint, kPairsOfBounce, 3u);

// White noise for paths: three numbers for each use at each surface, the same in all scenes.
VX_CONST(uint, kUseEvent, 0u);         // which lobe, Fresnel's choice, roulette
VX_CONST(uint, kUseEmitter, 1u);       // which emitter
VX_CONST(uint, kUseEmitterPoint, 2u);  // which point of it
VX_CONST(uint, kUseDirection, 3u);     // cosine-distributed direction
VX_CONST(uint, kUseSun, 4u);           // which point of the sun
VX_CONST(uint, kUseImage, 5u);         // the same for an image of the sun, and which image
VX_CONST(uint, kUseGlint, 6u);         // at mirrors and glass on the way to the sun: lobe, Fresnel's choice
VX_CONST(uint, kUsesOfSurface, 7u);

// Keeps them apart from other noise drawn with the same counters ("path" in ASCII).
VX_CONST(uint, kPathSalt, 0x70617468u);

// The numbers of a use at surface `surface` of a path, in [0, 1). The first word of pcg4d is biased (hash4).
VX_FN vec3 path_numbers(SampleKey key, uint surface, uint use) {
    uvec4 v = pcg4d(uvec4(key.seed, key.stream, key.index, kPathSalt + kUsesOfSurface * surface + use));
    return vec3(unit_float(pcg_hash(v.y)), unit_float(pcg_hash(v.z)), unit_float(pcg_hash(v.w)));
}

// Keeps the numbers of rays towards an image of the sky apart from all others ("sky" in ASCII).
VX_CONST(uint, kSkySalt, 0x736B79u);

// What a ray towards an image of the sky is drawn from: a texel takes all 32 bits, because there are up to
// 2^23 of them.
struct SkyNumbers {
    uint bits;
    float choice;
    vec2 place;
};

// Those of ray `number` of a sample's stream: one for each surface of a path.
VX_FN SkyNumbers sky_numbers(SampleKey key, uint number) {
    const uvec4 v = pcg4d(uvec4(key.seed, key.stream, key.index, kSkySalt + 2u * number));
    const uvec4 w = pcg4d(uvec4(key.seed, key.stream, key.index, kSkySalt + 2u * number + 1u));
    SkyNumbers numbers;
    numbers.bits = pcg_hash(v.y);
    numbers.choice = unit_float(pcg_hash(v.z));
    numbers.place = vec2(unit_float(pcg_hash(v.w)), unit_float(pcg_hash(w.y)));
    return numbers;
}

VX_END

#endif
