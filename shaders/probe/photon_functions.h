// Inputs of the photon probes.
#ifndef VX_PHOTON_FUNCTIONS_H
#define VX_PHOTON_FUNCTIONS_H

#include "shared/photon_types.h"

VX_BEGIN

struct PhotonIn {
    vec3 position;
    uint surface;
    vec3 power;
    uint is_stored;
};

VX_END

#endif
