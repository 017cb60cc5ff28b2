// The sky of an atmosphere, as computed by sky.view.
#ifndef VX_SKY_GLSL
#define VX_SKY_GLSL

#include "shared/sky_view.h"

layout(scalar) uniform Sky {
    SkyParams sky;
};
layout(scalar) readonly buffer SkyView {
    vec3 sky_view[];
};

vec3 load_view(uint i) {
    return sky_view[i];
}

#define VX_VIEW_PARAM
#define VX_VIEW_ARG
#include "shared/sky_lookup.h"

#endif
