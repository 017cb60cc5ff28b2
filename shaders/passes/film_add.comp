#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// Adds one value per invocation to an exact sum.

#include "lib/invocation.glsl"

#include "lib/counters_access.glsl"
#include "shared/film_sum.h"
#include "shared/gpu_types.h"

layout(scalar) readonly buffer Values {
    float values[];
};
layout(scalar) buffer Sums {
    uvec2 sums[];
};
layout(push_constant, scalar) uniform Push {
    FilmAddPush push;
};

void main() {
    uint i = linear_id();
    if (i >= push.count) return;
    FilmFixed added = film_fixed(values[i * push.values_stride]);
    uint at = push.first_sum + i;
    sums[at] = film_add(sums[at], added.sum);
    count(kFaultFilmClamped, (added.flags & kFilmClamped) != 0u ? 1u : 0u);
    count(kFaultFilmNonFinite, (added.flags & kFilmNonFinite) != 0u ? 1u : 0u);
}
