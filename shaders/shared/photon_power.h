// The power of a photon as three integers of 21 bits, so that sums over photons do not depend on their order.
//
// Range: the scale takes the largest power of a photon to kPhotonQuanta, which uses all bits, and 2^43
// photons of that power fit in a 64-bit sum, more than any store holds. With roulette by the largest
// component of the throughput no photon exceeds its initial power, so the host knows the largest power: that
// of the strongest light.
//
// Rounding: up with the probability of the fraction that is cut off, so the mean of many photons is exact,
// however dim they are. Rounding to nearest would reduce equal photons of 0.4 quanta to nothing. The
// probability is drawn from the photon's position: the same photon always rounds the same way. The error of a
// sum of n photons has a standard deviation of at most sqrt(n) / 2 quanta, or 2^-22 / sqrt(n) of the sum
// where they carry the largest power.
#ifndef VX_PHOTON_POWER_H
#define VX_PHOTON_POWER_H

#include "hash.h"
#include "portable.h"
#include "rng.h"

VX_BEGIN

VX_CONST(uint, kPhotonQuanta, 0x1FFFFFu);  // largest power of a photon, quanta

struct PackedPower {
    uvec2 words;
    bool is_sound;  // false when a component was negative, too large or not a number, and was clamped
};

struct Quanta {
    uint count;
    bool is_sound;
};

// `dither` in [0, 1).
VX_FN Quanta photon_quanta(float power, float scale, float dither) {
    Quanta quanta;
    VX_PRECISE float scaled = power * scale;
    quanta.is_sound = scaled >= 0.0f && scaled <= float(kPhotonQuanta);
    VX_PRECISE float bounded = quanta.is_sound ? scaled : (scaled > 0.0f ? float(kPhotonQuanta) : 0.0f);
    VX_PRECISE float whole = floor(bounded);
    VX_PRECISE float rest = bounded - whole;
    // rest + dither would round up to 1 too often; the comparison does not round.
    quanta.count = uint(whole) + (dither < rest ? 1u : 0u);
    return quanta;
}

// Packs a photon's power: bits 0 to 20 are red, 21 to 41 green, 42 to 62 blue.
VX_FN PackedPower pack_power(vec3 power, vec3 scale, vec3 position) {
    const uvec3 dither =
        pcg3d(uvec3(floatBitsToUint(position.x), floatBitsToUint(position.y), floatBitsToUint(position.z)));
    const Quanta red = photon_quanta(power.x, scale.x, unit_float(pcg_hash(dither.x)));
    const Quanta green = photon_quanta(power.y, scale.y, unit_float(pcg_hash(dither.y)));
    const Quanta blue = photon_quanta(power.z, scale.z, unit_float(pcg_hash(dither.z)));
    PackedPower packed;
    packed.words = uvec2(red.count | (green.count << 21u), (green.count >> 11u) | (blue.count << 10u));
    packed.is_sound = red.is_sound && green.is_sound && blue.is_sound;
    return packed;
}

// Quanta of red, green and blue.
VX_FN uvec3 unpack_power(uvec2 words) {
    return uvec3(words.x & kPhotonQuanta, ((words.x >> 21u) | (words.y << 11u)) & kPhotonQuanta,
                 words.y >> 10u);
}

// A 64-bit sum {low, high} as a float, with a single rounding of 2^-23.
VX_FN float photon_sum(uvec2 sum) {
    VX_PRECISE float high = float(sum.y) * 4294967296.0f;
    VX_PRECISE float value = high + float(sum.x);
    return value;
}

VX_END

#endif
