#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// How far the light of photons is off in each pixel because discs smooth it, as radiance. To first order the error of
// a disc is proportional to its area, and the narrow one has half of it: so it is twice the difference. Noisy, and its
// mean is not. Source: Hachisuka, Jarosz and Jensen 2010, "A Progressive Error Estimation Framework for Photon Density
// Estimation", for the idea; the second radius stands for their derivatives of the kernel.

#define VX_GROUP_2D
#include "lib/invocation.glsl"

#include "lib/constants.glsl"
#include "lib/frame_access.glsl"
#include "shared/limits.h"

VX_SPECIALIZED(uint, hits_stride, 1u);
VX_SPECIALIZED(uint, weights_stride, 1u);

layout(scalar) readonly buffer Hits {
    Hit hits[];
};
layout(scalar) readonly buffer Materials {
    SurfaceMaterial materials[];
};
layout(scalar) readonly buffer Light {
    vec3 light[];
};
layout(scalar) readonly buffer NarrowLight {
    vec3 narrow_light[];
};
layout(scalar) readonly buffer Weights {
    vec3 weights[];
};
layout(scalar) writeonly buffer Bias {
    vec3 bias[];
};

void main() {
    Pixel pixel = this_pixel();
    if (!pixel.inside) return;
    Hit hit = hits[pixel.index * hits_stride];
    vec3 off = vec3(0.0);
    if (hit.face <= kFaceSphereInside) {
        vec3 reflected = weights[pixel.index * weights_stride] * materials[hit.material].albedo * kInversePi;
        off = 2.0 * reflected * (light[pixel.index] - narrow_light[pixel.index]);
    }
    bias[pixel.index] = off;
}
