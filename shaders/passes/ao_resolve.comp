#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// Visibility of each hit: that of its cell, or of its own rays where it has no cell.

#include "lib/address.glsl"

#define VX_GROUP_2D
#include "lib/invocation.glsl"

#include "lib/frame_access.glsl"

#include "lib/constants.glsl"
#include "shared/ao_filter.h"
#include "shared/cell_age.h"

VX_SPECIALIZED(uint, wants_variance, 0u);
VX_SPECIALIZED(uint, ao_rays, 1u);  // per pixel and sample

layout(scalar) readonly buffer Slots {
    uint slots[];
};
layout(scalar) readonly buffer Samples {
    uint64_t samples[];
};
layout(scalar) readonly buffer Opens {
    uint64_t opens[];
};
layout(scalar) readonly buffer Own {
    float own_visibility[];
};
layout(scalar) writeonly buffer Ao {
    float ao[];
};
layout(scalar) writeonly buffer Variance {
    float variance[];
};

void main() {
    Pixel pixel = this_pixel();
    if (!pixel.inside) return;
    uint slot = slots[pixel.index];
    float visibility = own_visibility[pixel.index];
    float taken = float(ao_rays);
    if (slot != kNoSlot) {
        slot &= ~kSlotRests;
        taken = float(samples[slot]);
        visibility = float(opens[slot]) / taken;
    }
    ao[pixel.index] = visibility;
    if (wants_variance != 0u) variance[pixel.index] = visibility_variance(visibility, taken);
}
