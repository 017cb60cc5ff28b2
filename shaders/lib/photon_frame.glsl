// The parameters of an iteration of photon mapping.
#ifndef VX_PHOTON_FRAME_GLSL
#define VX_PHOTON_FRAME_GLSL

#include "shared/photon_types.h"

layout(scalar) uniform PhotonFrame {
    PhotonParams photon_block;
};

PhotonParams photon;

// Copies the parameters at the start of main(): lavapipe would load them anew in every turn of a loop.
void init_photons() {
    photon = photon_block;
}

#endif
