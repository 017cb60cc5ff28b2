// Exact film sums: signed 64-bit fixed point with kFilmFractionBits fraction bits, stored as two words {low,
// high} in two's complement. Integer sums do not depend on the order of the samples, and unlike float sums
// they do not stop growing.
#ifndef VX_FILM_SUM_H
#define VX_FILM_SUM_H

#include "limits.h"
#include "portable.h"

VX_BEGIN

// What happened to a sample on its way into the film; bits.
VX_CONST(uint, kFilmClamped, 1u);
VX_CONST(uint, kFilmNonFinite, 2u);

struct FilmFixed {
    uvec2 sum;   // {low, high}
    uint flags;  // kFilm* bits, 0 when the sample was taken as it is
};

// -v of a two-word integer.
VX_FN uvec2 film_negate(uvec2 v) {
    uint low = ~v.x + 1u;
    return uvec2(low, ~v.y + (low == 0u ? 1u : 0u));
}

// a + b with carry, modulo 2^64.
VX_FN uvec2 film_add(uvec2 a, uvec2 b) {
    uint low = a.x + b.x;
    return uvec2(low, a.y + b.y + (low < a.x ? 1u : 0u));
}

// True where a + b leaves the signed range: both have the sign that the sum does not have.
VX_FN bool film_add_overflows(uvec2 a, uvec2 b) {
    uvec2 sum = film_add(a, b);
    return (((a.y ^ sum.y) & (b.y ^ sum.y)) >> 31u) != 0u;
}

// The bits of a float >= 0 and below 2^39 as fixed point. Both parts of the value and their products with
// powers of two are exact, and a part that is rounded is below 2^8, so it cannot carry.
VX_FN uvec2 film_magnitude(uint bits) {
    float value = uintBitsToFloat(bits);
    float high = floor(value * 0.00390625f);  // in units of 2^8
    VX_PRECISE float low = value - high * 256.0f;
    return uvec2(uint(roundEven(low * float(1u << uint(kFilmFractionBits)))), uint(high));
}

// A sample as fixed point. Finite values round to the nearest 2^-24, ties to even; magnitudes above
// kFilmMaxValue become kFilmMaxValue and are flagged; infinities and NaN become 0 and are flagged. Reads the
// bits of the float, because drivers fold tests such as x - x.
VX_FN FilmFixed film_fixed(float value) {
    FilmFixed result;
    result.sum = uvec2(0u, 0u);
    result.flags = 0u;
    uint bits = floatBitsToUint(value);
    uint magnitude = bits & 0x7FFFFFFFu;
    if (magnitude >= 0x7F800000u) {
        result.flags = kFilmNonFinite;
        return result;
    }
    uint largest = floatBitsToUint(kFilmMaxValue);
    if (magnitude > largest) {
        magnitude = largest;
        result.flags = kFilmClamped;
    }
    result.sum = film_magnitude(magnitude);
    if ((bits >> 31u) != 0u) result.sum = film_negate(result.sum);
    return result;
}

// The square of film_fixed(value) as fixed point.
VX_FN uvec2 film_square(float value) {
    uint magnitude = floatBitsToUint(value) & 0x7FFFFFFFu;
    if (magnitude >= 0x7F800000u) return uvec2(0u, 0u);
    uint largest = floatBitsToUint(kFilmMaxValue);
    float taken = uintBitsToFloat(magnitude > largest ? largest : magnitude);
    return film_magnitude(floatBitsToUint(taken * taken));
}

// a + b for sums >= 0, saturating at the largest number: two samples of kFilmMaxValue reach it, or 2^20
// samples of 724.
VX_FN uvec2 film_add_square(uvec2 a, uvec2 b) {
    return film_add_overflows(a, b) ? uvec2(0xFFFFFFFFu, 0x7FFFFFFFu) : film_add(a, b);
}

// A sum as a float, with a relative error of at most 2^-22.
VX_FN float film_float(uvec2 sum) {
    bool is_negative = (sum.y >> 31u) != 0u;
    uvec2 magnitude = is_negative ? film_negate(sum) : sum;
    float value =
        (float(magnitude.y) * 4294967296.0f + float(magnitude.x)) / float(1u << uint(kFilmFractionBits));
    return is_negative ? -value : value;
}

VX_END

#endif
