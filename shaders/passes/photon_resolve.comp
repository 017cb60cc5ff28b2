#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// Irradiance at each visible point from the sums of photon_splat, or of photon_gather over several runs of
// photons.

#include "lib/address.glsl"

#define VX_GROUP_2D
#include "lib/invocation.glsl"

#include "lib/frame_access.glsl"
#include "lib/photon_frame.glsl"
#include "lib/photon_resolve.glsl"
#include "lib/photon_totals.glsl"

void main() {
    init_photons();
    Pixel pixel = this_pixel();
    if (!pixel.inside) return;
    uint first = 6u * pixel.index;
    PhotonSums sums = no_photons();
    sums.wide = u64vec3(totals[first], totals[first + 1u], totals[first + 2u]);
    sums.half_area = u64vec3(totals[first + 3u], totals[first + 4u], totals[first + 5u]);
    if (own_radii != 0u) sums.met = met_totals[pixel.index];
    resolve(pixel, hits[pixel.index], radius_of(pixel), sums);
}
