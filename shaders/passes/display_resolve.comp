#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// Means of the two halves of a film tile together, one value per invocation.

#include "lib/invocation.glsl"

#include "shared/film_sum.h"
#include "shared/gpu_types.h"

layout(scalar) readonly buffer SumsA {
    uvec2 sums_a[];
};
layout(scalar) readonly buffer SumsB {
    uvec2 sums_b[];
};
layout(scalar) writeonly buffer Display {
    float display[];
};
layout(push_constant, scalar) uniform Push {
    DisplayResolvePush push;
};

void main() {
    uint i = linear_id();
    if (i >= push.count) return;
    uint row = push.first_row + i / push.row_values;
    uint samples = push.samples + (row < push.rows_ahead ? 1u : 0u) - (row < push.rows_behind ? 1u : 0u);
    float sum = film_float(film_add(sums_a[i], sums_b[i]));
    display[push.first_row * push.row_values + i] = samples > 0u ? sum / float(samples) : 0.0;
}
