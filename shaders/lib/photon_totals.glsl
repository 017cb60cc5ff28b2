// Sums of photons over several runs, for each pixel of the tile.
#ifndef VX_PHOTON_TOTALS_GLSL
#define VX_PHOTON_TOTALS_GLSL

#include "lib/photon_light.glsl"

layout(scalar) buffer PhotonTotals {
    uint64_t totals[];  // quanta
};
layout(scalar) buffer MetTotals {
    uint met_totals[];  // photons, where pixels have radii of their own
};

#endif
