// The device side of sky_tables.h.
#ifndef VX_SKY_BUILD_GLSL
#define VX_SKY_BUILD_GLSL

layout(scalar) readonly buffer Scatter {
    uint scatter[];
};

uint load_scatter(uint i) {
    return scatter[i];
}

#define VX_SKY_PARAM
#define VX_SKY_ARG
#include "shared/sky_tables.h"

#endif
