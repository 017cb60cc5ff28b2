// What the shaders of a window and the program share: how a picture is shown.
#ifndef VX_WINDOW_H
#define VX_WINDOW_H

#include "portable.h"

VX_BEGIN

// WindowPush::shading: what becomes of the picture's values.
VX_CONST(uint, kShadeFilmic, 0u);       // exposed, filmic curve
VX_CONST(uint, kShadePlain, 1u);        // exposed, clamped
VX_CONST(uint, kShadeFalseColour, 2u);  // the first value between low and high, as false_colour()
VX_CONST(uint, kShadeDifference, 3u);   // |picture - reference|, exposed, clamped

// Push constants of everything that is drawn into a window.
struct WindowPush {
    vec2 window;      // pixels of the window
    ivec2 size;       // of the picture, which fills the window
    ivec2 reference;  // size of the other picture; 0: there is none
    float exposure;   // factor
    float low;        // values of the ends of the false colours
    float high;
    float wipe;  // columns from this one on show the other picture
    uint shading;
};

// A colour for [0,1], dark blue over green to yellow, in sRGB codes / 255. Its luminance rises all the way.
VX_FN vec3 false_colour(float value) {
    float x = clamp(value, 0.0f, 1.0f) * 3.0f;
    vec3 blue = vec3(0.15f, 0.05f, 0.35f);
    vec3 teal = vec3(0.13f, 0.45f, 0.55f);
    vec3 green = vec3(0.35f, 0.78f, 0.40f);
    vec3 yellow = vec3(0.99f, 0.91f, 0.25f);
    if (x < 1.0f) return mix(blue, teal, x);
    if (x < 2.0f) return mix(teal, green, x - 1.0f);
    return mix(green, yellow, x - 2.0f);
}

VX_END

#endif
