#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// Irradiance at each visible point from the photons around it, for two radii.

#include "lib/address.glsl"

#include "lib/invocation.glsl"

#include "lib/frame_access.glsl"
#include "lib/photon_frame.glsl"
#include "lib/photon_gather.glsl"
#include "lib/photon_share.glsl"

layout(scalar) readonly buffer Hits {
    Hit hits[];
};

void main() {
    Pixel pixel = tile_pixel();
    // Invocations outside the picture go along: photons are fetched by all of a subgroup.
    Hit hit;
    hit.face = kFaceMiss;
    if (pixel.inside) hit = hits[pixel.index];
    PhotonSums sums = gather(photon_position(hit), photon_surface(hit));
    if (!pixel.inside) return;
    store_light(pixel.index, sums, disc_share(hit, photon.radius), disc_share(hit, photon.narrow_radius));
}
