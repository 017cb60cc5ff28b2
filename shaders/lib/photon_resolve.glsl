// Turns the sums of photons at a visible point into light, with a radius of its own or the common one.
// Include lib/address.glsl, lib/frame_access.glsl and lib/photon_frame.glsl first.
#ifndef VX_PHOTON_RESOLVE_GLSL
#define VX_PHOTON_RESOLVE_GLSL

#include "lib/constants.glsl"
#include "lib/invocation.glsl"
#include "lib/photon_light.glsl"
#include "lib/photon_share.glsl"
#include "shared/sppm.h"

VX_SPECIALIZED(uint, own_radii, 0u);

layout(scalar) readonly buffer Hits {
    Hit hits[];
};
layout(scalar) buffer PixelRadii {
    PixelRadius radii[];
};

// The first iteration starts with the common radius, the largest that the grid allows.
PixelRadius radius_of(Pixel pixel) {
    PixelRadius radius;
    radius.squared = photon.radius * photon.radius;
    radius.photons = 0.0;
    if (own_radii != 0u && pixel.inside && photon.iteration > 1u) radius = radii[pixel.index];
    return radius;
}

Discs discs_of(PixelRadius radius) {
    Discs discs = common_discs();
    if (own_radii != 0u) {
        discs.squared = radius.squared;
        discs.half_area_squared = 0.5 * radius.squared;
    }
    return discs;
}

// Writes the light of all photons of an iteration.
void resolve(Pixel pixel, Hit hit, PixelRadius radius, PhotonSums sums) {
    Discs discs = discs_of(radius);
    vec2 shares = disc_shares(hit, vec2(sqrt(discs.squared), sqrt(discs.half_area_squared)));
    store_light(pixel.index, sums, discs, shares.x, shares.y);
    if (own_radii != 0u) radii[pixel.index] = shrunk_radius(radius, float(sums.met), photon.alpha);
}

#endif
