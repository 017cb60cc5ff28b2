// Adds values to the sums of the film, by groups of pixels. Include lib/address.glsl before any other file.
#ifndef VX_FILM_SUMS_GLSL
#define VX_FILM_SUMS_GLSL

#include "lib/texel_planes.glsl"
#include "shared/film_sum.h"

// Number of values so far that had to be clamped.
uint clamped = 0u;
uint non_finite = 0u;

uvec2 taken(float value) {
    FilmFixed added = film_fixed(value);
    clamped += (added.flags & kFilmClamped) != 0u ? 1u : 0u;
    non_finite += (added.flags & kFilmNonFinite) != 0u ? 1u : 0u;
    return added.sum;
}

// Adds two values to the two sums of a texel.
uvec4 add_pair(uvec4 sums, vec2 values) {
    return uvec4(film_add(sums.xy, taken(values.x)), film_add(sums.zw, taken(values.y)));
}

uvec4 add_squares(uvec4 sums, vec2 values) {
    return uvec4(film_add_square(sums.xy, film_square(values.x)), film_add_square(sums.zw, film_square(values.y)));
}

// Sums of the film: read as texels and written as 64-bit words, the faster way of each.
#define VX_SUMS(Sums)                                           \
    layout(rgba32ui) readonly uniform uimageBuffer Sums;        \
    layout(scalar) writeonly buffer Sums##Words {               \
        uint64_t Sums##_words[];                                \
    }

// Adds values of a group to its sums; add(sums, values) adds two values to two sums.
#define VX_ADD_PAIR(Sums, pair, add, values)                    \
    {                                                           \
        uvec4 vx_sums = add(VX_TEXEL(Sums, pair), values);      \
        Sums##_words[2u * (pair)] = pack64(vx_sums.xy);         \
        Sums##_words[2u * (pair) + 1u] = pack64(vx_sums.zw);    \
    }
#define VX_ADD_FLOATS(sums, group, add, values)              \
    VX_ADD_PAIR(sums, 2u * (group), add, (values).xy);       \
    VX_ADD_PAIR(sums, 2u * (group) + 1u, add, (values).zw)
#define VX_ADD_VECTORS(sums, group, add, values)                                       \
    VX_ADD_PAIR(sums, 6u * (group), add, values[0].xy);                                \
    VX_ADD_PAIR(sums, 6u * (group) + 1u, add, vec2(values[0].z, values[1].x));         \
    VX_ADD_PAIR(sums, 6u * (group) + 2u, add, values[1].yz);                           \
    VX_ADD_PAIR(sums, 6u * (group) + 3u, add, values[2].xy);                           \
    VX_ADD_PAIR(sums, 6u * (group) + 4u, add, vec2(values[2].z, values[3].x));         \
    VX_ADD_PAIR(sums, 6u * (group) + 5u, add, values[3].yz)

#endif
