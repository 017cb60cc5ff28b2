#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// Irradiance at each visible point from the sums of photon_splat.

#include "lib/address.glsl"

#define VX_GROUP_2D
#include "lib/invocation.glsl"

#include "lib/frame_access.glsl"
#include "lib/photon_frame.glsl"
#include "lib/photon_light.glsl"
#include "lib/photon_share.glsl"

layout(scalar) readonly buffer Hits {
    Hit hits[];
};
layout(scalar) readonly buffer PhotonTotals {
    uint64_t totals[];
};

void main() {
    init_photons();
    Pixel pixel = this_pixel();
    if (!pixel.inside) return;
    Hit hit = hits[pixel.index];
    uint first = 6u * pixel.index;
    PhotonSums sums;
    sums.wide = u64vec3(totals[first], totals[first + 1u], totals[first + 2u]);
    sums.half_area = u64vec3(totals[first + 3u], totals[first + 4u], totals[first + 5u]);
    vec2 shares = disc_shares(hit, vec2(photon.radius, photon.half_area_radius));
    store_light(pixel.index, sums, common_discs(), shares.x, shares.y);
}
