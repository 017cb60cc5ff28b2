#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// Position in scene space and depth along the view axis (panoramas: distance) of each hit. Misses have
// position 0 and depth kMissDepth.

#define VX_GROUP_2D
#include "lib/invocation.glsl"

#include "lib/constants.glsl"
#include "lib/frame_access.glsl"
#include "lib/projection.glsl"
#include "shared/limits.h"

VX_SPECIALIZED(uint, hits_stride, 1u);

layout(scalar) readonly buffer Hits {
    Hit hits[];
};
layout(scalar) writeonly buffer Position {
    vec3 position[];
};
layout(scalar) writeonly buffer Depth {
    float depth[];
};

void main() {
    Pixel pixel = this_pixel();
    if (!pixel.inside) return;
    Hit hit = hits[pixel.index * hits_stride];
    bool is_hit = hit.face <= kFaceSphereInside;
    vec3 from_camera = vec3(hit.cell - frame.camera_cell) + (hit.fraction - frame.camera_fraction);
    uint film_index = (pixel.y - frame.film_tile_first_row) * frame.column_count + pixel.x - frame.first_column;
    position[film_index] = is_hit ? vec3(frame.world_origin + hit.cell) + hit.fraction : vec3(0.0);
    bool is_panorama = projection == kEquirectangular || projection == kFisheye;
    float along = is_panorama ? length(from_camera) : dot(from_camera, frame.camera_forward);
    depth[film_index] = is_hit ? along : kMissDepth;
}
