#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// Irradiance at each visible point from the photons around it, for two radii. Pixels may have radii of their own, which
// shrink with the photons that they meet.

#include "lib/address.glsl"

#include "lib/invocation.glsl"

#include "lib/frame_access.glsl"
#include "lib/photon_frame.glsl"
#include "lib/photon_gather.glsl"
#include "lib/photon_share.glsl"
#include "shared/sppm.h"

layout(scalar) readonly buffer Hits {
    Hit hits[];
};

layout(scalar) buffer PixelRadii {
    PixelRadius radii[];
};

// The first iteration starts with the common radius, the largest that the grid is made for.
PixelRadius radius_of(Pixel pixel) {
    PixelRadius radius;
    radius.squared = photon.radius * photon.radius;
    radius.photons = 0.0;
    if (own_radii != 0u && pixel.inside && photon.iteration > 1u) radius = radii[pixel.index];
    return radius;
}

void main() {
    init_photons();
    Pixel pixel = tile_pixel();
    // Invocations outside the picture go along: photons are fetched by all of a subgroup.
    Hit hit;
    hit.face = kFaceMiss;
    if (pixel.inside) hit = hits[pixel.index];
    PixelRadius radius = radius_of(pixel);
    Discs discs = common_discs();
    if (own_radii != 0u) {
        discs.squared = radius.squared;
        discs.half_area_squared = 0.5 * radius.squared;
    }
    PhotonSums sums = gather(photon_position(hit), photon_surface(hit), discs);
    if (!pixel.inside) return;
    vec2 shares = disc_shares(hit, vec2(sqrt(discs.squared), sqrt(discs.half_area_squared)));
    store_light(pixel.index, sums, discs, shares.x, shares.y);
    if (own_radii != 0u) radii[pixel.index] = shrunk_radius(radius, float(sums.met), photon.alpha);
}
