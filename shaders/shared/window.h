// What the shaders of a window, those of the pictures that it shows, and the program share.
#ifndef VX_WINDOW_H
#define VX_WINDOW_H

#include "portable.h"

VX_BEGIN

// What the values of a picture mean, and so how they become colours.
VX_CONST(uint, kShowsRadiance, 0u);  // exposed, through the tone curve
VX_CONST(uint, kShowsAlbedo, 1u);    // as it is
VX_CONST(uint, kShowsVector, 2u);    // components from low to high
VX_CONST(uint, kShowsNumber, 3u);    // a false colour, from low to high
VX_CONST(uint, kShowsError, 4u);     // of the mean: a false colour of its logarithm to base 10

// What the columns from the divider on show.
VX_CONST(uint, kComparesNothing, 0u);
VX_CONST(uint, kComparesReference, 1u);
VX_CONST(uint, kComparesDifference, 2u);  // from the reference, without its sign
VX_CONST(uint, kComparesMap, 3u);         // numbers in [0,1] in its place, as false colours

// Push constants of display_resolve, for one film tile.
struct DisplayResolvePush {
    vec3 low;          // values that colours begin at
    vec3 high;         // and end at
    uint pixel_count;  // of the film tile
    uint width;        // of the image, pixels
    uint first_row;    // of the film tile in the image
    uint samples;      // of all rows
    uint rows_ahead;   // rows from the top of the image that have one sample more
    float exposure;    // factor
    uint divider;      // column from which on the picture is compared
};

// Push constants of display_cells.
struct DisplayCellsPush {
    uint pixel_count;
    float low;   // logarithms to base 10 of the samples of a cell that colours begin at
    float high;  // and end at
};

// Push constants of what is drawn over the picture in a window.
struct WindowPush {
    vec2 window;  // pixels of the window
};

VX_END

#endif
