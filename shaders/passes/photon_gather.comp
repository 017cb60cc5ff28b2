#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// Irradiance at each visible point from the photons around it, for two radii.

#include "lib/address.glsl"

#include "lib/invocation.glsl"

#include "lib/frame_access.glsl"
#include "lib/photon_frame.glsl"
#include "lib/photon_gather.glsl"

layout(scalar) readonly buffer Hits {
    Hit hits[];
};

void main() {
    Pixel pixel = tile_pixel();
    // Invocations outside the picture go along: photons are fetched by all of a subgroup.
    uint surface = kNoSurface;
    vec3 position = vec3(0.0);
    if (pixel.inside) {
        Hit hit = hits[pixel.index];
        surface = photon_surface(hit);
        position = photon_position(hit);
    }
    PhotonSums sums = gather(position, surface);
    if (pixel.inside) store_light(pixel.index, sums, 1.0);
}
