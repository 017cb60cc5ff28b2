// Directions in proportion to the light that the sky sends to a voxel face: the probability of a bin
// (sky_bins.h) is proportional to its radiance times its cosine to the face. A bin is drawn by inverting a
// distribution over rows and one over the bins of a row, which keeps the stratification of low-discrepancy
// points (Pharr et al., "Physically Based Rendering", 4th edition, section A.5); within a bin, directions are
// uniform, so that the density is known exactly. The including file defines VX_SAMPLE_PARAM and VX_SAMPLE_ARG
// and load_share(), which reads a number of the distributions.
#ifndef VX_SKY_SAMPLE_H
#define VX_SKY_SAMPLE_H

#include "sky_bins.h"

VX_BEGIN

struct DrawnShare {
    uint number;
    float place;  // of u within its interval, [0, 1)
    float share;
};

// The one of 64 intervals of [0, 1) that contains u. `first`: index of their cumulative distribution.
VX_FN DrawnShare draw_share(VX_SAMPLE_PARAM uint first, float u) {
    uint number = 0u;
    for (uint step = kSkyBins / 2u; step > 0u; step /= 2u)
        number += load_share(VX_SAMPLE_ARG first + number + step - 1u) <= u ? step : 0u;
    const float low = number == 0u ? 0.0f : load_share(VX_SAMPLE_ARG first + number - 1u);
    DrawnShare drawn;
    drawn.number = number;
    drawn.share = load_share(VX_SAMPLE_ARG first + number) - low;
    drawn.place = clamp((u - low) / max(drawn.share, 1e-9f), 0.0f, 0.99999994f);
    return drawn;
}

struct SkySample {
    vec3 direction;
    float pdf;  // per steradian
};

VX_FN SkySample sample_sky(VX_SAMPLE_PARAM uint face, vec2 u) {
    const uint first = face * kFaceShares;
    const DrawnShare row = draw_share(VX_SAMPLE_ARG first, u.x);
    const DrawnShare bin = draw_share(VX_SAMPLE_ARG first + kSkyBins * (1u + row.number), u.y);
    SkySample drawn;
    drawn.direction = bin_direction(row.number, bin.number, vec2(row.place, bin.place));
    drawn.pdf = row.share * bin.share * (float(kSkyBins * kSkyBins) * 0.25f * kInversePi);
    return drawn;
}

VX_END

#endif
