// The device side of sky_tables.h.
#ifndef VX_SKY_BUILD_GLSL
#define VX_SKY_BUILD_GLSL

layout(rgba32ui) readonly uniform uimageBuffer Scatter;

uvec4 load_scatter(uint i) {
    return imageLoad(Scatter, int(i));
}

#define VX_SKY_PARAM
#define VX_SKY_ARG
#include "shared/sky_tables.h"

#endif
