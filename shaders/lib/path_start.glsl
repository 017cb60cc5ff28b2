// Where paths start, as texels: lavapipe loads them for eight invocations at once (lab/notes/film.md).
#ifndef VX_PATH_START_GLSL
#define VX_PATH_START_GLSL

#include "lib/constants.glsl"
#include "shared/gpu_types.h"

VX_SPECIALIZED(uint, keeps_normals, 0u);

layout(rgba32ui) uniform uimageBuffer Starts;

void put_path_start(uint i, PathStart start) {
    int first = int(kPathStartTexels * i);
    imageStore(Starts, first, uvec4(start.cell, start.stream));
    imageStore(Starts, first + 1, uvec4(floatBitsToUint(start.fraction), start.own));
    imageStore(Starts, first + 2, uvec4(floatBitsToUint(start.direction), start.medium));
    if (keeps_normals != 0u) imageStore(Starts, first + 3, uvec4(floatBitsToUint(start.normal), start.is_rough));
}

bool starts_rough(uint i) {
    return imageLoad(Starts, int(kPathStartTexels * i) + 3).w != 0u;
}

void put_no_rough_start(uint i) {
    imageStore(Starts, int(kPathStartTexels * i) + 3, uvec4(0u));
}

PathStart path_start(uint i) {
    int first = int(kPathStartTexels * i);
    uvec4 origin = imageLoad(Starts, first);
    uvec4 fraction = imageLoad(Starts, first + 1);
    uvec4 direction = imageLoad(Starts, first + 2);
    PathStart start;
    start.cell = ivec3(origin.xyz);
    start.stream = origin.w;
    start.fraction = uintBitsToFloat(fraction.xyz);
    start.own = fraction.w;
    start.direction = uintBitsToFloat(direction.xyz);
    start.medium = direction.w;
    start.normal = vec3(0.0, 0.0, 1.0);
    start.is_rough = 0u;
    if (keeps_normals != 0u) {
        uvec4 last = imageLoad(Starts, first + 3);
        start.normal = uintBitsToFloat(last.xyz);
        start.is_rough = last.w;
    }
    return start;
}

#endif
