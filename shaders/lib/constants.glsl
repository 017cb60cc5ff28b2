// VX_SPECIALIZED(type, name, value); at the start of a line declares a specialization constant. The host sets
// it by name; the build assigns its number (number_constants.cmake).
#ifndef VX_CONSTANTS_GLSL
#define VX_CONSTANTS_GLSL

#include "constant_ids.glsl"

#define VX_SPECIALIZED(type, name, value) layout(constant_id = VX_ID_##name) const type name = value

#endif
