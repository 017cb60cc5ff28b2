// Planes whose elements an invocation reads or writes four at a time, for the pixels of a group: floats,
// vectors, hits and sums are then whole texels of four words. Lavapipe accesses the words of a bound block
// one by one, for one invocation after the other; a texel takes a fifth of the time to load, and half to
// store. These are macros because a texel buffer cannot be an argument.
#ifndef VX_TEXEL_PLANES_GLSL
#define VX_TEXEL_PLANES_GLSL

#include "lib/hit_words.glsl"

vec3[kGroupPixels] vectors_of(vec4 a, vec4 b, vec4 c) {
    return vec3[kGroupPixels](a.xyz, vec3(a.w, b.xy), vec3(b.zw, c.x), c.yzw);
}

vec3[kGroupPixels] repeated(float value) {
    return vec3[kGroupPixels](vec3(value), vec3(value), vec3(value), vec3(value));
}

Hit[kGroupPixels] hits_of(uvec4 texels[kHitWords]) {
    Hit hits[kGroupPixels];
    for (uint k = 0u; k < kGroupPixels; ++k) {
        uint words[kHitWords];
        for (uint i = 0u; i < kHitWords; ++i)
            words[i] = texels[(kHitWords * k + i) / 4u][(kHitWords * k + i) % 4u];
        hits[k] = hit_of(words);
    }
    return hits;
}

#define VX_TEXEL(plane, at) imageLoad(plane, int(at))

// The values of a group. A plane of stride 0 has one texel, of equal values.
#define VX_FLOATS(plane, at) uintBitsToFloat(VX_TEXEL(plane, at))
#define VX_GROUP_FLOATS(plane, group, stride) VX_FLOATS(plane, (stride) * (group))
#define VX_GROUP_VECTORS(plane, group, stride)                                                                   \
    ((stride) == 0u ? repeated(VX_FLOATS(plane, 0u).x)                                                           \
                    : vectors_of(VX_FLOATS(plane, 3u * (group)), VX_FLOATS(plane, 3u * (group) + 1u),            \
                                 VX_FLOATS(plane, 3u * (group) + 2u)))
#define VX_HIT_TEXEL(plane, group, stride, i) VX_TEXEL(plane, (stride) * (kHitWords * (group) + i))
#define VX_GROUP_HITS(plane, group, stride)                                                                      \
    hits_of(uvec4[kHitWords](                                                                                    \
        VX_HIT_TEXEL(plane, group, stride, 0u), VX_HIT_TEXEL(plane, group, stride, 1u),                          \
        VX_HIT_TEXEL(plane, group, stride, 2u), VX_HIT_TEXEL(plane, group, stride, 3u),                          \
        VX_HIT_TEXEL(plane, group, stride, 4u), VX_HIT_TEXEL(plane, group, stride, 5u),                          \
        VX_HIT_TEXEL(plane, group, stride, 6u), VX_HIT_TEXEL(plane, group, stride, 7u),                          \
        VX_HIT_TEXEL(plane, group, stride, 8u), VX_HIT_TEXEL(plane, group, stride, 9u)))

#define VX_STORE_VECTORS(plane, group, values)                                                  \
    imageStore(plane, int(3u * (group)), floatBitsToUint(vec4(values[0], values[1].x)));         \
    imageStore(plane, int(3u * (group) + 1u), floatBitsToUint(vec4(values[1].yz, values[2].xy))); \
    imageStore(plane, int(3u * (group) + 2u), floatBitsToUint(vec4(values[2].z, values[3])))

#endif
