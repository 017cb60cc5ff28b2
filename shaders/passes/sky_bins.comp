#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// The radiance of the sky at the centre of each bin that directions are drawn from (sky_sample.h), a bin per
// invocation.

#include "lib/invocation.glsl"
#include "lib/sky.glsl"
#include "shared/sky_bins.h"

layout(scalar) writeonly buffer SkyBins {
    float sky_bins[];
};

void main() {
    uint i = linear_id();
    if (i >= kSkyBins * kSkyBins) return;
    vec3 light = sky_radiance(sky, bin_direction(i / kSkyBins, i % kSkyBins, vec2(0.5)));
    sky_bins[i] = light.x + light.y + light.z;
}
