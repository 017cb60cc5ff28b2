// The list of photon starts, read and written two words at a time: lavapipe loads for one invocation after
// the other. Include lib/address.glsl first.
#ifndef VX_PHOTON_START_GLSL
#define VX_PHOTON_START_GLSL

#include "shared/gpu_types.h"

layout(scalar) buffer Starts {
    uint64_t start_words[];
};

void put_start(uint place, PhotonStart start) {
    uint first = kStartWords * place;
    uvec3 fraction = floatBitsToUint(start.fraction);
    uvec3 direction = floatBitsToUint(start.direction);
    uvec3 power = floatBitsToUint(start.power);
    start_words[first] = pack64(uvec2(start.cell.x, start.cell.y));
    start_words[first + 1u] = pack64(uvec2(start.cell.z, fraction.x));
    start_words[first + 2u] = pack64(fraction.yz);
    start_words[first + 3u] = pack64(direction.xy);
    start_words[first + 4u] = pack64(uvec2(direction.z, start.sphere));
    start_words[first + 5u] = pack64(power.xy);
    start_words[first + 6u] = pack64(uvec2(power.z, start.noise));
}

PhotonStart photon_start(uint place) {
    uint first = kStartWords * place;
    uvec2 cell = unpack32(start_words[first]);
    uvec2 cell_fraction = unpack32(start_words[first + 1u]);
    uvec2 fraction = unpack32(start_words[first + 2u]);
    uvec2 direction = unpack32(start_words[first + 3u]);
    uvec2 direction_sphere = unpack32(start_words[first + 4u]);
    uvec2 power = unpack32(start_words[first + 5u]);
    uvec2 power_noise = unpack32(start_words[first + 6u]);
    PhotonStart start;
    start.cell = ivec3(cell, cell_fraction.x);
    start.fraction = uintBitsToFloat(uvec3(cell_fraction.y, fraction));
    start.direction = uintBitsToFloat(uvec3(direction, direction_sphere.x));
    start.sphere = direction_sphere.y;
    start.power = uintBitsToFloat(uvec3(power, power_noise.x));
    start.noise = power_noise.y;
    return start;
}

#endif
