// The camera's projection. As a constant of the pipeline it costs perspective nothing.
#ifndef VX_PROJECTION_GLSL
#define VX_PROJECTION_GLSL

#include "lib/constants.glsl"

VX_SPECIALIZED(uint, projection, 0u);  // kPerspective, ...

#endif
