// What the shaders of a window and the program share: how a picture is shown.
#ifndef VX_WINDOW_H
#define VX_WINDOW_H

#include "portable.h"

VX_BEGIN

// Push constants of everything that is drawn into a window.
struct WindowPush {
    vec2 window;     // pixels of the window
    ivec2 size;      // of the picture, which fills the window; 0: there is none
    float exposure;  // factor
    uint is_filmic;  // the filmic curve, else values are clamped
};

VX_END

#endif
