#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// Cumulative distribution over the rows of bins, for a face, like that of sky_columns within a row: a face
// per invocation.

#include "lib/invocation.glsl"
#include "shared/sky_bins.h"

layout(scalar) readonly buffer SkyRows {
    float sky_rows[];
};
layout(scalar) writeonly buffer SkyShares {
    float sky_shares[];
};

void main() {
    uint face = linear_id();
    if (face >= kFaceCount) return;
    float total = 0.0;
    for (uint row = 0u; row < kSkyBins; ++row)
        total += sky_rows[face * kSkyBins + row];
    float sum = 0.0;
    for (uint row = 0u; row < kSkyBins; ++row) {
        sum += sky_rows[face * kSkyBins + row];
        sky_shares[face * kFaceShares + row] = summed_share(sum, total, row);
    }
}
