#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// The sky as the scene sees it: a texel of its table (sky_view.h) per invocation.

#define VX_LINEAR_GROUP 8
#include "lib/invocation.glsl"
#include "lib/sky_build.glsl"

layout(push_constant, scalar) uniform Push {
    SkyParams sky;
};
layout(scalar) writeonly buffer SkyView {
    vec3 sky_view[];
};

void main() {
    uint i = linear_id();
    if (i >= view_texels(sky.resolution)) return;
    uint columns = view_columns(sky.resolution);
    ViewTexel texel = view_texel(sky, i / columns, i % columns);
    sky_view[kViewColours * i] = texel.light;
    sky_view[kViewColours * i + 1u] = texel.mie;
}
