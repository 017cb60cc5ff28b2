#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// Sorts each visible point into its bucket.

#define VX_GROUP_2D
#include "lib/invocation.glsl"

#include "lib/frame_access.glsl"
#include "lib/photon_frame.glsl"
#include "shared/photon_cell.h"

layout(scalar) readonly buffer Hits {
    Hit hits[];
};
layout(scalar) readonly buffer PointRanks {
    uint point_ranks[];
};
layout(scalar) readonly buffer BucketStarts {
    uint bucket_starts[];
};
layout(scalar) writeonly buffer SortedPoints {
    PhotonPoint sorted_points[];
};

void main() {
    init_photons();
    Pixel pixel = this_pixel();
    if (!pixel.inside) return;
    Hit hit = hits[pixel.index];
    PhotonPoint point;
    point.position = photon_position(hit);
    point.surface = photon_surface(hit);
    point.pixel = pixel.index;
    if (point.surface == kNoSurface) return;
    sorted_points[bucket_starts[photon_bucket(point.position, point.surface, photon.grid)] + point_ranks[pixel.index]] =
        point;
}
