// From linear light to what a display shows, for PNGs on the host and for a window on the device.
#ifndef VX_TONE_CURVE_H
#define VX_TONE_CURVE_H

#include "portable.h"

VX_BEGIN

// Matches the fit to the luminance of the ACES reference (Narkowicz 2016).
VX_CONST(float, kPreExposure, 0.6f);
// The fit exceeds 1 from 7.25 on; for large values, its squares would overflow.
VX_CONST(float, kFitWhite, 16.0f);

// Filmic: of the published curves (Hable 2010, Narkowicz 2016, Khronos PBR Neutral 2024) this fit has the
// fewest constants (K. Narkowicz 2016). It maps 0 to 0, rises everywhere, and HDR-FLIP uses the same curve,
// so the metric sees the same error as a viewer. `linear` >= 0.
VX_FN float filmic_curve(float linear) {
    float x = min(linear * kPreExposure, kFitWhite);
    return min(x * (2.51f * x + 0.03f) / (x * (2.43f * x + 0.59f) + 0.14f), 1.0f);
}

// The transfer function of IEC 61966-2-1 (sRGB), for values in [0,1]. Thresholds are the standard's.
VX_FN float encode_srgb(float linear) {
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * pow(linear, 1.0f / 2.4f) - 0.055f;
}

// Relative luminance of a linear Rec. 709 colour (ITU-R BT.709-6, item 3.2).
VX_FN float luminance_of(vec3 rgb) {
    return 0.2126f * rgb.x + 0.7152f * rgb.y + 0.0722f * rgb.z;
}

VX_END

#endif
