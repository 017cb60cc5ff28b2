#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// Radiance of each camera ray: emission, the constant sky through the ambient occlusion, and the sun, off Lambertian
// surfaces. An effect that is off is a constant of stride 0.

#define VX_GROUP_2D
#include "lib/invocation.glsl"

#include "lib/frame_access.glsl"
#include "lib/tally_access.glsl"
#include "shared/limits.h"

layout(constant_id = 2) const uint hits_stride = 1u;
layout(constant_id = 3) const uint ao_stride = 1u;
layout(constant_id = 4) const uint sun_stride = 1u;

layout(scalar) readonly buffer Hits {
    Hit hits[];
};
layout(scalar) readonly buffer Materials {
    SurfaceMaterial materials[];
};
layout(scalar) readonly buffer Ao {
    float ao[];
};
layout(scalar) readonly buffer Sun {
    float sun[];
};
layout(scalar) writeonly buffer Color {
    vec3 color[];
};

void main() {
    Pixel pixel = this_pixel();
    if (!pixel.inside) return;
    Hit hit = hits[pixel.index * hits_stride];
    bool is_hit = hit.face <= kFaceSphere;
    vec3 radiance = frame.sky_radiance;
    if (is_hit) {
        SurfaceMaterial material = materials[hit.material];
        vec3 ambient = frame.sky_radiance * ao[pixel.index * ao_stride];
        vec3 direct = frame.sun_irradiance * (sun[pixel.index * sun_stride] * kInversePi);
        radiance = material.emission + material.albedo * (ambient + direct);
    }
    count(kWorkHits, is_hit ? 1u : 0u);
    color[pixel.index] = radiance;
}
