// The parameters of an iteration of photon mapping.
#ifndef VX_PHOTON_FRAME_GLSL
#define VX_PHOTON_FRAME_GLSL

#include "shared/photon_types.h"

layout(scalar) uniform PhotonFrame {
    PhotonParams photon;
};

#endif
