// The bins from which directions towards the sky are drawn (sky_sample.h): equal steps of the height on the
// unit sphere times equal azimuths, so that all have the same solid angle.
#ifndef VX_SKY_BINS_H
#define VX_SKY_BINS_H

#include "limits.h"
#include "portable.h"
#include "sampling.h"

VX_BEGIN

// Per face: the cumulative distribution over rows, then for each row the one over its bins.
VX_CONST(uint, kSkyBins, 64u);  // rows, and bins per row
VX_CONST(uint, kFaceShares, kSkyBins + kSkyBins * kSkyBins);
VX_CONST(uint, kSkyShares, kFaceCount* kFaceShares);
// Added to the cosines, so that every direction out of a face can be drawn even where a bin straddles its
// horizon, and no sample is more than some 50 times as bright as the mean.
VX_CONST(float, kSkyCosineFloor, 0.02f);

// A direction of a bin: `place` is in [0, 1)^2.
VX_FN vec3 bin_direction(uint row, uint column, vec2 place) {
    const float z = 2.0f * ((float(row) + place.x) / float(kSkyBins)) - 1.0f;
    const float azimuth = 2.0f * kPi * ((float(column) + place.y) / float(kSkyBins));
    const float horizontal = sqrt(max(1.0f - z * z, 0.0f));
    return vec3(horizontal * cos(azimuth), horizontal * sin(azimuth), z);
}

// The weight of a bin for a face, up to a constant. light: the sum of the colours at the centre of the bin.
VX_FN float bin_weight(uint face, uint row, uint column, float light) {
    const float cosine = dot(bin_direction(row, column, vec2(0.5f)), face_normal(face));
    return (max(cosine, 0.0f) + kSkyCosineFloor) * light;
}

// A sum over the first of kSkyBins weights as a fraction of their total.
VX_FN float summed_share(float sum, float total, uint number) {
    if (number == kSkyBins - 1u) return 1.0f;
    return total > 0.0f ? min(sum / total, 1.0f) : float(number + 1u) / float(kSkyBins);
}

VX_END

#endif
