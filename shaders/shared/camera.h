// Camera rays, and how a ray that starts outside the world gets into it.
#ifndef VX_CAMERA_H
#define VX_CAMERA_H

#include "dimensions.h"
#include "gpu_types.h"
#include "limits.h"
#include "march.h"
#include "portable.h"
#include "projection.h"
#include "sequence.h"
#include "two_float.h"

VX_BEGIN

// The ray through pixel (x, y), row 0 at the top, at a point of the pixel drawn from the sequence with a
// kSequence* id. Box filter. All techniques take their camera rays from here.
VX_FN Ray camera_ray(FrameParams frame, uint projection, uint sequence, uint x, uint y) {
    const SampleKey key = sample_key(y * frame.width + x, uvec2(frame.sample_index, 0u), frame.seed);
    const vec2 jitter = sample_2d(sequence, key, kPairPixel);
    if (projection == kOrthographic) return orthographic_ray(frame, x, y, jitter);
    if (projection == kEquirectangular || projection == kFisheye)
        return panorama_ray(frame, projection, x, y, jitter);
    VX_PRECISE float right = 2.0f * (float(x) + jitter.x) / float(frame.width) - 1.0f;
    VX_PRECISE float up = 1.0f - 2.0f * (float(y) + jitter.y) / float(frame.height);
    VX_PRECISE vec3 v = frame.camera_forward + right * frame.camera_right + up * frame.camera_up;
    if (projection == kThinLens)
        return lens_ray(frame, v, aperture_point(frame.lens_blades, sample_2d(sequence, key, kPairLens)));
    VX_PRECISE float square = dot(v, v);  // >= 1: forward is unit, and the others are perpendicular to it
    Ray ray;
    ray.cell = frame.camera_cell;
    ray.fraction = frame.camera_fraction;
    ray.direction = v / sqrt(square);
    ray.t_max = kUnbounded;
    return ray;
}

struct WorldEntry {
    Ray ray;  // restarted at the border of the world, with the remaining t_max
    float t;  // from the start to the border
    bool enters;
};

// Whole planes crossed at `time`, and the rest in [0, 1).
VX_FN PlaneCount count_planes(TwoFloat time, float speed, int flip, float offset) {
    const TwoFloat moved = tf_mul_float(time, speed);
    const TwoFloat start = two_sum(float(-flip), -offset);
    return count_whole(tf_add(moved, start));
}

// Time at which an axis has crossed `planes` planes; below 0, and therefore never the latest, when it has
// none to cross.
VX_FN TwoFloat entry_time(int planes, int flip, float offset, float speed) {
    if (planes <= 0) return two_float(-1.0f, 0.0f);
    return tf_div(two_sum(float(planes + flip), offset), two_float(speed, 0.0f));
}

VX_FN bool is_later(TwoFloat a, TwoFloat b) {
    return a.hi > b.hi || (a.hi == b.hi && a.lo > b.lo);
}

// Restarts a ray at the border of the world's `size` cells, so that the march counts from there and keeps its
// full precision wherever the ray comes from. Times and positions here have 48 bits: a camera a million
// voxels away is off by less than 2^-24 voxel. A ray that starts inside is returned as it is.
VX_FN WorldEntry enter_world(Ray ray, ivec3 size) {
    WorldEntry entry;
    entry.ray = ray;
    entry.t = 0.0f;
    entry.enters = true;
    if (!is_outside(ray.cell, size) || !is_sound(ray)) return entry;
    const MarchAxes axes = march_axes(ray);
    const ivec3 ahead = ivec3(axes.sign_mask.x < 0 ? ray.cell.x - size.x + 1 : -ray.cell.x,
                              axes.sign_mask.y < 0 ? ray.cell.y - size.y + 1 : -ray.cell.y,
                              axes.sign_mask.z < 0 ? ray.cell.z - size.z + 1 : -ray.cell.z);
    const bool stuck = (ahead.x > 0 && axes.speed.x == 0.0f) || (ahead.y > 0 && axes.speed.y == 0.0f) ||
                       (ahead.z > 0 && axes.speed.z == 0.0f);
    const TwoFloat tx = entry_time(ahead.x, axes.sign_mask.x, axes.offset.x, axes.speed.x);
    const TwoFloat ty = entry_time(ahead.y, axes.sign_mask.y, axes.offset.y, axes.speed.y);
    const TwoFloat tz = entry_time(ahead.z, axes.sign_mask.z, axes.offset.z, axes.speed.z);
    TwoFloat t = tx;
    int axis = 0;
    if (is_later(ty, t)) {
        t = ty;
        axis = 1;
    }
    if (is_later(tz, t)) {
        t = tz;
        axis = 2;
    }
    entry.enters = !stuck && t.hi >= 0.0f && t.hi < kFarthestEntry && t.hi < ray.t_max;
    if (!entry.enters) return entry;
    PlaneCount nx = count_planes(t, axes.speed.x, axes.sign_mask.x, axes.offset.x);
    PlaneCount ny = count_planes(t, axes.speed.y, axes.sign_mask.y, axes.offset.y);
    PlaneCount nz = count_planes(t, axes.speed.z, axes.sign_mask.z, axes.offset.z);
    // Rounding must not leave a ray just short of a plane that it has reached.
    if (axis == 0 || nx.whole < ahead.x) nx.rest = 0.0f;
    if (axis == 1 || ny.whole < ahead.y) ny.rest = 0.0f;
    if (axis == 2 || nz.whole < ahead.z) nz.rest = 0.0f;
    const ivec3 reached =
        ivec3(axis == 0 ? ahead.x : nx.whole, axis == 1 ? ahead.y : ny.whole, axis == 2 ? ahead.z : nz.whole);
    const ivec3 n = max(reached, ahead);
    entry.ray.cell = ray.cell + (n ^ axes.sign_mask) - axes.sign_mask;
    entry.ray.fraction =
        vec3(axes.speed.x == 0.0f ? ray.fraction.x : (axes.sign_mask.x < 0 ? 1.0f - nx.rest : nx.rest),
             axes.speed.y == 0.0f ? ray.fraction.y : (axes.sign_mask.y < 0 ? 1.0f - ny.rest : ny.rest),
             axes.speed.z == 0.0f ? ray.fraction.z : (axes.sign_mask.z < 0 ? 1.0f - nz.rest : nz.rest));
    entry.ray.t_max = ray.t_max - t.hi;
    entry.t = t.hi;
    entry.enters = !is_outside(entry.ray.cell, size);
    return entry;
}

VX_END

#endif
