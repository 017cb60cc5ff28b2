#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// One iteration of the a-trous filter of visibility. Only voxel faces are filtered; spheres keep the value of
// their own rays.

#define VX_GROUP_2D
#include "lib/invocation.glsl"

#include "lib/frame_access.glsl"
#include "lib/projection.glsl"
#include "shared/ao_filter.h"
#include "shared/projection.h"

layout(scalar) readonly buffer Hits {
    Hit hits[];
};
layout(scalar) readonly buffer Ao {
    float ao[];
};
layout(scalar) readonly buffer Variance {
    float variance[];
};
layout(scalar) writeonly buffer FilteredAo {
    float filtered_ao[];
};
layout(scalar) writeonly buffer FilteredVariance {
    float filtered_variance[];
};
layout(push_constant, scalar) uniform Push {
    AoFilterPush push;
};

float height_over(Hit centre, Hit tap) {
    vec3 offset = vec3(tap.cell - centre.cell) + (tap.fraction - centre.fraction);
    uint axis = centre.face >> 1u;
    return axis == 0u ? offset.x : (axis == 1u ? offset.y : offset.z);
}

void main() {
    Pixel pixel = this_pixel();
    if (!pixel.inside) return;
    Hit centre = hits[pixel.index];
    float visibility = ao[pixel.index];
    float spread = variance[pixel.index];
    vec3 sum = vec3(visibility, spread, 1.0) * 36.0;
    ivec2 place = ivec2(pixel.x - frame.first_column, pixel.y - frame.first_row);
    float footprint = pixel_growth(projection, centre.t) * pixel_width(frame, projection) * float(push.step);
    for (int i = 0; i < 25 && centre.face < kFaceInside; ++i) {
        ivec2 offset = ivec2(i % 5 - 2, i / 5 - 2);
        ivec2 at = place + offset * push.step;
        bool inside = at.x >= 0 && at.y >= 0 && at.x < int(frame.column_count) && at.y < int(frame.row_count);
        if (i == 12 || !inside) continue;
        uint index = uint(at.y) * frame.column_count + uint(at.x);
        Hit tap = hits[index];
        if (tap.face != centre.face) continue;
        float weight = spline_weight(offset.x) * spline_weight(offset.y) *
                       plane_weight(height_over(centre, tap), footprint) * value_weight(ao[index] - visibility, spread);
        sum += weight * vec3(ao[index], variance[index], 1.0);
    }
    filtered_ao[pixel.index] = sum.x / sum.z;
    filtered_variance[pixel.index] = sum.y / sum.z;
}
