#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// Irradiance at each visible point from the photons around it, for two radii. Pixels may have radii of their
// own, which shrink with the photons that they gather. Where the photons of an iteration come in several
// runs, their sums are added up for photon_resolve.

#include "lib/address.glsl"

#include "lib/invocation.glsl"

#include "lib/frame_access.glsl"
#include "lib/photon_frame.glsl"
#include "lib/photon_resolve.glsl"
#include "lib/photon_gather.glsl"
#include "lib/photon_totals.glsl"

VX_SPECIALIZED(uint, adds_up, 0u);

void add_to_totals(uint pixel, PhotonSums sums) {
    for (uint c = 0u; c < 3u; ++c) {
        totals[6u * pixel + c] += sums.wide[c];
        totals[6u * pixel + 3u + c] += sums.half_area[c];
    }
    if (own_radii != 0u) met_totals[pixel] += sums.met;
}

void main() {
    init_photons();
    Pixel pixel = tile_pixel();
    // Invocations outside the image take part, too, because all of a subgroup fetch photons.
    Hit hit;
    hit.face = kFaceMiss;
    if (pixel.inside) hit = hits[pixel.index];
    PixelRadius radius = radius_of(pixel);
    PhotonSums sums = gather(photon_position(hit), photon_surface(hit), discs_of(radius));
    if (!pixel.inside) return;
    if (adds_up != 0u)
        add_to_totals(pixel.index, sums);
    else
        resolve(pixel, hit, radius, sums);
}
