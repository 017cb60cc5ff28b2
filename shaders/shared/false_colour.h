// Numbers as colours, for maps on the host and for a window on the device.
#ifndef VX_FALSE_COLOUR_H
#define VX_FALSE_COLOUR_H

#include "portable.h"

VX_BEGIN

// sRGB codes in [0,1] of a number in [0,1], from black through purple and orange to pale yellow: interpolated
// between five entries of matplotlib's map "magma", a quarter of its range apart (N. Smith and S. van der
// Walt, 2015, public domain). Its lightness rises evenly, also in print and for colour-blind viewers.
VX_FN vec3 false_colour(float number) {
    vec3 a = vec3(0.0f, 0.0f, 4.0f);
    vec3 b = vec3(81.0f, 18.0f, 124.0f);
    vec3 c = vec3(183.0f, 55.0f, 121.0f);
    vec3 d = vec3(252.0f, 137.0f, 97.0f);
    vec3 e = vec3(252.0f, 253.0f, 191.0f);
    float place = 4.0f * clamp(number, 0.0f, 1.0f);
    vec3 low = place < 1.0f ? a : place < 2.0f ? b : place < 3.0f ? c : d;
    vec3 high = place < 1.0f ? b : place < 2.0f ? c : place < 3.0f ? d : e;
    float share = place - min(floor(place), 3.0f);
    return (low + (high - low) * share) / 255.0f;
}

VX_END

#endif
