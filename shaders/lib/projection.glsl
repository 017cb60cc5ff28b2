// The camera's projection. As a specialization constant it costs nothing for perspective.
#ifndef VX_PROJECTION_GLSL
#define VX_PROJECTION_GLSL

#include "lib/constants.glsl"
#include "shared/projection.h"

VX_SPECIALIZED(uint, projection, 0u);  // kPerspective etc.

#endif
