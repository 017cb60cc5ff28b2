// An edge-avoiding a-trous filter of visibility. Source: Dammertz et al. 2010, "Edge-Avoiding A-Trous Wavelet
// Transform for fast Global Illumination Filtering", HPG, section 3: a 5x5 B3 spline whose taps move apart by
// powers of two. Our edge-stopping functions: the one for depth measures the tap's distance from the plane of
// the centre's face, which is the analytic depth gradient without its division; the one for values takes its
// width from the number of samples, so the filter fades as the cells converge and leaves no bias behind.
#ifndef VX_AO_FILTER_H
#define VX_AO_FILTER_H

#include "limits.h"
#include "portable.h"

VX_BEGIN

// Variance of a visibility measured with `taken` rays: binomial, with Laplace's rule of succession applied,
// so that 0 or 1 of few rays does not count as certain.
VX_FN float visibility_variance(float visibility, float taken) {
    const float share = (visibility * taken + 1.0f) / (taken + 2.0f);
    return share * (1.0f - share) / max(taken, 1.0f);
}

// Weight of a tap 0..2 pixels from the centre on one axis, times 16.
VX_FN float spline_weight(int offset) {
    const int distance = abs(offset);
    return distance == 0 ? 6.0f : (distance == 1 ? 4.0f : 1.0f);
}

// Weight of a tap that is `height` voxels off the plane of the centre's face, where the tap's distance in the
// image is `footprint` voxels wide: 1 in the plane, 0 beyond the footprint.
VX_FN float plane_weight(float height, float footprint) {
    if (height == 0.0f) return 1.0f;  // also where the footprint is 0, at the camera
    return max(0.0f, 1.0f - abs(height) / footprint);
}

// Weight of a tap whose value differs by `difference` from a centre of variance `variance` >= 0.
VX_FN float value_weight(float difference, float variance) {
    if (difference == 0.0f) return 1.0f;  // even if so many samples agree that the variance rounds to 0
    return max(0.0f, 1.0f - abs(difference) / (kAoFilterSigmas * sqrt(variance)));
}

VX_END

#endif
