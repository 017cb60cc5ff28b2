#ifndef VX_INTERLEAVED_ROW_GLSL
#define VX_INTERLEAVED_ROW_GLSL

// Software devices give each thread one contiguous half of the workgroups, and the sky is cheap: rows of groups are
// dealt alternately to both halves, so that a picture with sky on top keeps all threads busy.
uint interleaved_row(uint row, uint rows) {
    uint first_half = (rows + 1u) / 2u;
    return row < first_half ? 2u * row : 2u * (row - first_half) + 1u;
}

#endif
