#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// Light of an atmosphere, or of an image of the sky, where ambient visibility is known. For a ray that leaves
// the scene: the radiance of the sky there. For a hit: irradiance / pi of the whole sky, times the
// visibility. A sphere's irradiance is interpolated between the faces by the squares of its normal (the
// ambient cube of McTaggart 2004, "Half-Life 2 / Valve Source Shading").

#include "lib/address.glsl"

#define VX_GROUP_2D
#include "lib/invocation.glsl"

#include "lib/surface.glsl"
#include "lib/sky_seen.glsl"

VX_SPECIALIZED(uint, hits_stride, 1u);
VX_SPECIALIZED(uint, ao_stride, 1u);
VX_SPECIALIZED(uint, paths_find_sky, 0u);  // at surfaces

layout(scalar) readonly buffer Hits {
    Hit hits[];
};
layout(scalar) readonly buffer Ao {
    float ao[];
};
layout(scalar) readonly buffer SkyFaces {
    vec3 sky_faces[];
};
layout(scalar) writeonly buffer SkyLight {
    vec3 sky_light[];
};

// Irradiance / pi of an unoccluded surface.
vec3 open_irradiance(vec3 normal) {
    vec3 share = normal * normal;
    return share.x * sky_faces[normal.x < 0.0 ? 0u : 1u] + share.y * sky_faces[normal.y < 0.0 ? 2u : 3u] +
           share.z * sky_faces[normal.z < 0.0 ? 4u : 5u];
}

void main() {
    init_sky_image();
    Pixel pixel = this_pixel();
    if (!pixel.inside) return;
    Hit hit = hits[pixel.index * hits_stride];
    vec3 light = vec3(0.0);
    if (!is_surface(hit)) {
        light = seen_sky(pixel, hit);
    } else if (paths_find_sky == 0u && hit.face != kFaceInside) {
        light = open_irradiance(surface_normal(hit)) * ao[pixel.index * ao_stride];
    }
    sky_light[pixel.index] = light;
}
