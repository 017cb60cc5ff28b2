#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// Radiance of each camera ray: emission, and off Lambertian surfaces the light of the sky (a constant one through the
// ambient occlusion), the sun, the emitters, and what photons brought. An effect that is off is a constant of stride 0.

#define VX_GROUP_2D
#include "lib/invocation.glsl"

#include "lib/constants.glsl"
#include "lib/frame_access.glsl"
#include "lib/counters_access.glsl"
#include "shared/limits.h"

VX_SPECIALIZED(uint, hits_stride, 1u);
VX_SPECIALIZED(uint, ao_stride, 1u);
VX_SPECIALIZED(uint, sky_stride, 0u);  // 0: the sky is constant
VX_SPECIALIZED(uint, sun_stride, 1u);
VX_SPECIALIZED(uint, direct_stride, 1u);
VX_SPECIALIZED(uint, photons_stride, 1u);
VX_SPECIALIZED(uint, weights_stride, 1u);

layout(scalar) readonly buffer Hits {
    Hit hits[];
};
layout(scalar) readonly buffer Materials {
    SurfaceMaterial materials[];
};
layout(scalar) readonly buffer Ao {
    float ao[];
};
layout(scalar) readonly buffer SkyLight {
    vec3 sky_light[];
};
layout(scalar) readonly buffer Sun {
    float sun[];
};
layout(scalar) readonly buffer Direct {
    vec3 direct[];
};
layout(scalar) readonly buffer Photons {
    vec3 photons[];
};
layout(scalar) readonly buffer Weights {
    vec3 weights[];
};
layout(scalar) writeonly buffer Color {
    vec3 color[];
};

void main() {
    Pixel pixel = this_pixel();
    if (!pixel.inside) return;
    Hit hit = hits[pixel.index * hits_stride];
    bool is_hit = hit.face <= kFaceSphereInside;
    vec3 radiance = sky_stride == 0u ? frame.sky_radiance : sky_light[pixel.index];
    if (is_hit) {
        SurfaceMaterial material = materials[hit.material];
        vec3 ambient = sky_stride == 0u ? frame.sky_radiance * ao[pixel.index * ao_stride] : radiance;
        vec3 sunlight = frame.sun_irradiance * (sun[pixel.index * sun_stride] * kInversePi);
        vec3 emitter_light = direct[pixel.index * direct_stride] + kInversePi * photons[pixel.index * photons_stride];
        vec3 emission = hit.face == kFaceSphereInside ? vec3(0.0) : material.emission;
        radiance = emission + material.albedo * (ambient + sunlight + emitter_light);
    }
    count(kWorkHits, is_hit ? 1u : 0u);
    color[pixel.index] = radiance * weights[pixel.index * weights_stride];
}
