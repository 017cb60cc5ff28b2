// An equirectangular image of the sky. Rows go from the zenith to the nadir; seen from above, columns turn
// clockwise, and the middle of the image is in the direction +x, turned counter-clockwise by `turn` (of a
// full turn). A texel has the same radiance everywhere, so that sampling a texel by its luminance times its
// solid angle, and then a direction in it uniformly over the solid angle, has a density that is known exactly
// and in proportion to the luminance. A blend of texels would be smoother to look at, but is not in
// proportion to any density that a table of texels gives.
#ifndef VX_SKY_IMAGE_H
#define VX_SKY_IMAGE_H

#include "limits.h"
#include "portable.h"

VX_BEGIN

struct SkyGrid {
    uint columns;
    uint rows;
    float turn;  // of the image, counter-clockwise seen from above, in full turns: [-1/2, 1/2]
};

// The texel that a unit direction is in.
VX_FN uint sky_texel(SkyGrid grid, vec3 direction) {
    const float horizontal = sqrt(direction.x * direction.x + direction.y * direction.y);
    const float polar = atan(horizontal, direction.z) * kInversePi;
    const uint row = min(uint(polar * float(grid.rows)), grid.rows - 1u);
    const float azimuth = horizontal > 0.0f ? atan(direction.y, direction.x) : 0.0f;
    const float place = 0.5f + grid.turn - azimuth * (0.5f * kInversePi);
    const float part = max(place - floor(place), 0.0f);
    return row * grid.columns + min(uint(part * float(grid.columns)), grid.columns - 1u);
}

// 1 - cos of the polar angle of the border above row `row`: without cancellation, so that texels at a pole
// keep their shape.
VX_FN float sky_border(SkyGrid grid, uint row) {
    const float s = sin((0.5f * kPi) * (float(row) / float(grid.rows)));
    return 2.0f * s * s;
}

// A direction in a texel, uniform over its solid angle; `place` is in [0, 1)^2.
VX_FN vec3 sky_direction(SkyGrid grid, uint texel, vec2 place) {
    const uint row = texel / grid.columns;
    const uint column = texel - row * grid.columns;
    const bool is_low = 2u * row >= grid.rows;
    const uint near = is_low ? grid.rows - 1u - row : row;  // rows between it and the nearer pole
    const float height = mix(sky_border(grid, near), sky_border(grid, near + 1u), place.y);
    const float horizontal = sqrt(max(height * (2.0f - height), 0.0f));
    const float azimuth = (2.0f * kPi) * (0.5f + grid.turn - (float(column) + place.x) / float(grid.columns));
    return vec3(horizontal * cos(azimuth), horizontal * sin(azimuth), is_low ? height - 1.0f : 1.0f - height);
}

VX_END

#endif
