#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// Counts the visible points of each bucket, for splatting.

#define VX_GROUP_2D
#include "lib/invocation.glsl"

#include "lib/frame_access.glsl"
#include "lib/photon_frame.glsl"
#include "shared/photon_cell.h"

layout(scalar) readonly buffer Hits {
    Hit hits[];
};
layout(scalar) buffer BucketCounts {
    uint bucket_counts[];
};
layout(scalar) writeonly buffer PointRanks {
    uint point_ranks[];
};

void main() {
    init_photons();
    Pixel pixel = this_pixel();
    if (!pixel.inside) return;
    Hit hit = hits[pixel.index];
    uint surface = photon_surface(hit);
    if (surface == kNoSurface) return;
    point_ranks[pixel.index] = atomicAdd(bucket_counts[photon_bucket(photon_position(hit), surface, photon.grid)], 1u);
}
