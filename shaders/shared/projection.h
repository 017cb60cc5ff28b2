// The projections of a camera other than perspective (camera.h): where their rays start and point.
//
// Orthographic: parallel rays. Pixels are counted in blocks that are as wide as camera_right is long, from a
// point where a block begins. For a camera that looks along an axis with an integer number of pixels per
// voxel, a block is one voxel wide; the cell in which a ray starts then follows from integers alone, and no
// rounding moves a ray across the border of a pixel.
//
// Panoramas: longitude and latitude (equirectangular), or an angle from the view axis in proportion to the
// distance from the centre of the image (fisheye, equidistant).
//
// Thin lens: perspective through an aperture. What lies in the plane of focus is sharp, see lens_ray.
#ifndef VX_PROJECTION_H
#define VX_PROJECTION_H

#include "gpu_types.h"
#include "limits.h"
#include "portable.h"
#include "sampling.h"
#include "two_float.h"

VX_BEGIN

// How a camera maps directions to pixels, in the order of the scene's Projection.
VX_CONST(uint, kPerspective, 0u);
VX_CONST(uint, kOrthographic, 1u);
VX_CONST(uint, kEquirectangular, 2u);
VX_CONST(uint, kFisheye, 3u);
VX_CONST(uint, kThinLens, 4u);  // kPerspective, with the effect of that name

// A number as its floor and the rest in [0, 1].
struct PlaneCount {
    int whole;
    float rest;
};

VX_FN PlaneCount count_whole(TwoFloat number) {
    PlaneCount count;
    const float whole = floor(min(number.hi, kFarthestPlanes));
    VX_PRECISE float rest = (number.hi - whole) + number.lo;
    count.whole = int(whole) + (rest < 0.0f ? -1 : 0) + (rest >= 1.0f ? 1 : 0);
    count.rest = clamp(rest < 0.0f ? rest + 1.0f : (rest >= 1.0f ? rest - 1.0f : rest), 0.0f, 1.0f);
    return count;
}

// Position of an image point along one axis: whole blocks, and the rest in blocks.
VX_FN PlaneCount image_blocks(uint pixel, float point, uint block) {
    PlaneCount count;
    const uint whole = pixel / block;
    const float rest = (float(pixel - whole * block) + point) / float(block);
    count.whole = int(whole);
    count.rest = clamp(rest, kPixelInset, 1.0f - kPixelInset);
    return count;
}

// The length of `blocks` blocks of length `step`.
VX_FN TwoFloat blocks_along(PlaneCount blocks, float step) {
    return tf_add(two_prod(float(blocks.whole), step), two_prod(blocks.rest, step));
}

// One coordinate of the start of an orthographic ray, from the cell of the camera.
VX_FN PlaneCount orthographic_start(PlaneCount across, PlaneCount down, float right, float up,
                                    float fraction) {
    const TwoFloat offset = tf_add(blocks_along(across, right), blocks_along(down, -up));
    return count_whole(tf_add(offset, two_float(fraction, 0.0f)));
}

// The ray at `point` of a pixel, [0,1]^2.
VX_FN Ray orthographic_ray(FrameParams frame, uint x, uint y, vec2 point) {
    const PlaneCount across = image_blocks(x + frame.camera_pixel.x, point.x, frame.camera_block);
    const PlaneCount down = image_blocks(y + frame.camera_pixel.y, point.y, frame.camera_block);
    const PlaneCount at_x =
        orthographic_start(across, down, frame.camera_right.x, frame.camera_up.x, frame.camera_fraction.x);
    const PlaneCount at_y =
        orthographic_start(across, down, frame.camera_right.y, frame.camera_up.y, frame.camera_fraction.y);
    const PlaneCount at_z =
        orthographic_start(across, down, frame.camera_right.z, frame.camera_up.z, frame.camera_fraction.z);
    Ray ray;
    ray.cell = frame.camera_cell + ivec3(at_x.whole, at_y.whole, at_z.whole);
    ray.fraction = vec3(at_x.rest, at_y.rest, at_z.rest);
    ray.direction = frame.camera_forward;
    ray.t_max = kUnbounded;
    return ray;
}

// Unit direction through a point of the image, in pixels from its upper left corner. The centre of an
// equirectangular image looks forward, columns turn clockwise seen from above, and rows go from the zenith to
// the nadir. The edge of a fisheye at pi is the direction backwards.
VX_FN vec3 panorama_direction(FrameParams frame, uint projection, float x, float y) {
    vec3 v;
    if (projection == kEquirectangular) {
        const float azimuth = kPi * (1.0f - 2.0f * x / float(frame.width));  // counter-clockwise
        const float elevation = kPi * (0.5f - y / float(frame.height));
        v = cos(elevation) * (cos(azimuth) * frame.camera_forward - sin(azimuth) * frame.camera_right) +
            sin(elevation) * frame.camera_up;
    } else {
        const float right = (2.0f * x - float(frame.width)) / float(frame.height);
        const float up = (float(frame.height) - 2.0f * y) / float(frame.height);
        const float radius = sqrt(right * right + up * up);
        const float angle = min(radius * frame.camera_angle, kPi);
        const float scale = radius > 0.0f ? sin(angle) / radius : 0.0f;
        v = cos(angle) * frame.camera_forward + scale * (right * frame.camera_right + up * frame.camera_up);
    }
    return v / sqrt(dot(v, v));
}

VX_FN Ray panorama_ray(FrameParams frame, uint projection, uint x, uint y, vec2 point) {
    Ray ray;
    ray.cell = frame.camera_cell;
    ray.fraction = frame.camera_fraction;
    ray.direction = panorama_direction(frame, projection, float(x) + point.x, float(y) + point.y);
    ray.t_max = kUnbounded;
    return ray;
}

// Uniform point of a disc of radius 1, or of the regular polygon of `blades` >= 3 corners on its rim.
VX_FN vec2 aperture_point(uint blades, vec2 u) {
    if (blades < 3u) {
        const vec3 disk = concentric_disk(u);
        return vec2(disk.x, disk.y);
    }
    const float turn = u.x * float(blades);
    const float corner = min(floor(turn), float(blades) - 1.0f);
    const float angle = 2.0f * kPi / float(blades);
    const vec2 first = vec2(cos(corner * angle), sin(corner * angle));
    const vec2 second = vec2(cos((corner + 1.0f) * angle), sin((corner + 1.0f) * angle));
    const vec2 rim = first + (turn - corner) * (second - first);
    return sqrt(u.y) * rim;
}

// The ray through a point of the aperture towards where the pinhole's ray along `through` (1 along the view
// axis) meets the plane of focus. Source: Potmesil and Chakravarty 1982, "Synthetic Image Generation with a
// Lens and Aperture Camera Model"; the thin lens of Pharr et al., "Physically Based Rendering", 4th edition,
// section 5.2.3.
VX_FN Ray lens_ray(FrameParams frame, vec3 through, vec2 aperture) {
    VX_PRECISE vec3 right = frame.camera_right / sqrt(dot(frame.camera_right, frame.camera_right));
    VX_PRECISE vec3 up = frame.camera_up / sqrt(dot(frame.camera_up, frame.camera_up));
    VX_PRECISE vec3 offset = frame.lens_radius * (aperture.x * right + aperture.y * up);
    VX_PRECISE vec3 v = through - frame.lens_power * offset;
    VX_PRECISE float square = dot(v, v);  // >= 1, as the offset is at right angles to the view axis
    const PlaneCount x = count_whole(two_sum(frame.camera_fraction.x, offset.x));
    const PlaneCount y = count_whole(two_sum(frame.camera_fraction.y, offset.y));
    const PlaneCount z = count_whole(two_sum(frame.camera_fraction.z, offset.z));
    Ray ray;
    ray.cell = frame.camera_cell + ivec3(x.whole, y.whole, z.whole);
    ray.fraction = vec3(x.rest, y.rest, z.rest);
    ray.direction = v / sqrt(square);
    ray.t_max = kUnbounded;
    return ray;
}

// What the width of a pixel is proportional to: the distance, except for parallel rays.
VX_FN float pixel_growth(uint projection, float distance) {
    return projection == kOrthographic ? 1.0f : distance;
}

// Width of a pixel at distance 1 (orthographic: anywhere), voxels. For a panorama, of a pixel at its centre.
VX_FN float pixel_width(FrameParams frame, uint projection) {
    if (projection == kOrthographic) return length(frame.camera_up) / float(frame.camera_block);
    if (projection == kEquirectangular) return kPi / float(frame.height);
    if (projection == kFisheye) return 2.0f * frame.camera_angle / float(frame.height);
    return 2.0f * length(frame.camera_up) / float(frame.height);
}

VX_END

#endif
