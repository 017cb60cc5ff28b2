#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// Cumulative distribution over the bins of a row, for a face: a row of a face per invocation (sky_bins.h).
// The last entry is exactly 1; where no light comes from the row, the distribution is uniform.

#include "lib/invocation.glsl"
#include "shared/sky_bins.h"

layout(scalar) readonly buffer SkyBins {
    float sky_bins[];
};
layout(scalar) writeonly buffer SkyRows {
    float sky_rows[];
};
layout(scalar) writeonly buffer SkyShares {
    float sky_shares[];
};

void main() {
    uint i = linear_id();
    if (i >= kFaceCount * kSkyBins) return;
    uint face = i / kSkyBins;
    uint row = i % kSkyBins;
    float total = 0.0;
    for (uint column = 0u; column < kSkyBins; ++column)
        total += bin_weight(face, row, column, sky_bins[row * kSkyBins + column]);
    uint first = face * kFaceShares + kSkyBins * (1u + row);
    float sum = 0.0;
    for (uint column = 0u; column < kSkyBins; ++column) {
        sum += bin_weight(face, row, column, sky_bins[row * kSkyBins + column]);
        sky_shares[first + column] = summed_share(sum, total, column);
    }
    sky_rows[i] = total;
}
