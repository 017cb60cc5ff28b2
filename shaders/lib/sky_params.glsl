// What the sky of an atmosphere depends on.
#ifndef VX_SKY_PARAMS_GLSL
#define VX_SKY_PARAMS_GLSL

#include "lib/constants.glsl"
#include "shared/sky_view.h"

VX_SPECIALIZED(uint, traces_air, 0u);  // paths through the air find its light, instead of tables

layout(scalar) uniform Sky {
    SkyParams sky;
};

#endif
