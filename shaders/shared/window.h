// What the program shares with the shaders of a window and of the images that it shows.
#ifndef VX_WINDOW_H
#define VX_WINDOW_H

#include "portable.h"

VX_BEGIN

// What the values of an image mean, which decides how they become colours.
VX_CONST(uint, kShowsRadiance, 0u);  // exposed, through the tone curve
VX_CONST(uint, kShowsAlbedo, 1u);    // unchanged
VX_CONST(uint, kShowsVector, 2u);    // components from low to high
VX_CONST(uint, kShowsNumber, 3u);    // a false colour, from low to high
VX_CONST(uint, kShowsError, 4u);     // of the mean: a false colour of its base 10 logarithm

// What the columns from the divider on show.
VX_CONST(uint, kComparesNothing, 0u);
VX_CONST(uint, kComparesReference, 1u);
VX_CONST(uint, kComparesDifference, 2u);  // absolute difference from the reference
VX_CONST(uint, kComparesMap, 3u);         // numbers in [0,1] in place of the reference, as false colours

// Push constants of display_resolve, for one film tile.
struct DisplayResolvePush {
    vec3 low;          // values where colours begin
    vec3 high;         // and end
    uint pixel_count;  // of the film tile
    uint width;        // of the image, pixels
    uint first_row;    // of the film tile in the image
    uint samples;      // of all rows
    uint rows_ahead;   // rows from the top of the image that have one sample more
    float exposure;    // multiplies the radiance
    uint divider;      // first column that is compared
};

// Push constants of display_cells.
struct DisplayCellsPush {
    uint pixel_count;
    float low;   // log10 of the samples of a cell where colours begin
    float high;  // and end
};

// Push constants of display_steps.
struct DisplayRangePush {
    float low;   // log10 of the steps where colours begin
    float high;  // and end
};

// Push constants of what is drawn over the image in a window.
struct WindowPush {
    vec2 window;      // pixels of the window
    uint font_width;  // texels
};

VX_END

#endif
