// How far all camera rays of a tile of pixels run through empty space: a beam around them is marched once,
// and the rays start where it ends.
//
// A beam is a cone with its tip at the camera: at time t it reaches `spread` * t beyond t *
// `axis` on each of the three axes of the world. It moves from empty box to empty box (the boxes of
// world_cell.h) as long as the whole cross-section fits into one. (Beams for primary rays: Amanatides, Ray
// Tracing with Cones, 1984; their use as starting points: Laine & Karras, Efficient Sparse Voxel Octrees,
// 2010, section 4.4.)
//
// No ray of the tile hits a solid cell before the beam's end, so march_from gives the hit of march, bit
// for bit. The beam includes rounding errors: directions, crossings and positions are off by a few units of
// 2^-23 of the distance, and kBeamError of the distance is added to the spread.
//
// The including file provides what find_cell.h requires.
#ifndef VX_BEAM_H
#define VX_BEAM_H

#include "find_cell.h"
#include "gpu_types.h"
#include "limits.h"
#include "portable.h"
#include "projection.h"

VX_BEGIN

struct Beam {
    ivec3 cell;  // of the tip
    vec3 fraction;
    vec3 axis;     // unit
    float spread;  // longest distance between the axis and the unit direction of a ray
    vec3 pad;      // of its cross-section at the tip, on each axis
};

// Unit direction through a point of the image, in pixels from its upper left corner.
VX_FN vec3 picture_direction(FrameParams frame, float x, float y) {
    const float right = 2.0f * x / float(frame.width) - 1.0f;
    const float up = 1.0f - 2.0f * y / float(frame.height);
    return normalize(frame.camera_forward + right * frame.camera_right + up * frame.camera_up);
}

// Unit direction of a camera that sees from one point, or from around it.
VX_FN vec3 pinhole_direction(FrameParams frame, uint projection, float x, float y) {
    return projection == kPerspective || projection == kThinLens
               ? picture_direction(frame, x, y)
               : panorama_direction(frame, projection, x, y);
}

// Parallel rays: their distances from the middle one are the same everywhere.
VX_FN Beam parallel_beam(FrameParams frame, uint x, uint y) {
    const Ray middle = orthographic_ray(frame, x + kBeamPixels / 2u, y + kBeamPixels / 2u, vec2(0.0f));
    Beam beam;
    beam.cell = middle.cell;
    beam.fraction = middle.fraction;
    beam.axis = frame.camera_forward;
    beam.spread = kBeamError;
    const float half_tile = 0.5f * float(kBeamPixels) / float(frame.camera_block);
    beam.pad = kBeamPad + half_tile * (abs(frame.camera_right) + abs(frame.camera_up));
    return beam;
}

// The beam of all camera rays (camera.h) of the tile whose upper left pixel is (x, y).
VX_FN Beam tile_beam(FrameParams frame, uint projection, uint x, uint y) {
    if (projection == kOrthographic) return parallel_beam(frame, x, y);
    const float left = float(x);
    const float top = float(y);
    const float edge = float(kBeamPixels);
    Beam beam;
    beam.cell = frame.camera_cell;
    beam.fraction = frame.camera_fraction;
    beam.axis = pinhole_direction(frame, projection, left + 0.5f * edge, top + 0.5f * edge);
    const float upper = max(distance(beam.axis, pinhole_direction(frame, projection, left, top)),
                            distance(beam.axis, pinhole_direction(frame, projection, left + edge, top)));
    const float lower =
        max(distance(beam.axis, pinhole_direction(frame, projection, left, top + edge)),
            distance(beam.axis, pinhole_direction(frame, projection, left + edge, top + edge)));
    float widest = max(upper, lower);
    // Where the angle ends at pi, an edge may bulge beyond the corners. An equidistant map stretches nothing,
    // so the angle of half a tile's diagonal bounds the whole tile.
    if (projection == kFisheye) widest = 1.41421356f * edge * frame.camera_angle / float(frame.height);
    beam.spread = widest * kBeamMargin + kBeamError;
    beam.pad = vec3(kBeamPad);
    // A point of the aperture shifts the start by at most its radius, and the direction, before it is made
    // unit, by that over the distance of focus: no more afterwards, since it is 1 or longer.
    if (projection == kThinLens) {
        beam.pad = vec3(kBeamPad + kBeamMargin * frame.lens_radius);
        beam.spread += kBeamMargin * frame.lens_radius * frame.lens_power;
    }
    return beam;
}

// Time at which one axis of the beam leaves an interval of positions relative to the tip; below 0
// when it is not inside at t.
VX_FN float leave_interval(float axis, float spread, float low, float high, float t) {
    const float upper = axis + spread;
    const float lower = axis - spread;
    if (upper * t > high || lower * t < low) return -1.0f;
    const float rise = upper > kMinDirection ? high / upper : kUnbounded;
    const float fall = lower < -kMinDirection ? low / lower : kUnbounded;
    return min(rise, fall);
}

// Time up to which the beam stays in the empty box around a cell, whose position is relative to the
// tip's cell; below 0 when the beam is not inside at t. The space around the world is empty.
VX_FN float leave_box(VX_WORLD_PARAM Beam beam, ivec3 cell, float t, ivec3 chunks) {
    const ivec3 size = chunks << kChunkLog2;
    const ivec3 local = clamp(beam.cell + cell, ivec3(0), size - 1);
    const MarchCell found = find_cell(VX_WORLD_ARG local, chunks);
    if (cell_state(found.cell) == kCellSolid) return -1.0f;
    const uint ones = (1u << found.bits) - 1u;
    const uint below = cell_payload(found.cell);
    const uint above = below >> found.bits;
    const uint pair = 2u * found.bits;
    const ivec3 home = local >> found.log2;
    const ivec3 first =
        (home - ivec3(int(below & ones), int((below >> pair) & ones), int((below >> (2u * pair)) & ones)))
        << found.log2;
    const ivec3 end =
        (home + 1 + ivec3(int(above & ones), int((above >> pair) & ones), int((above >> (2u * pair)) & ones)))
        << found.log2;
    const vec3 low = vec3(first - beam.cell) - beam.fraction + beam.pad;
    const vec3 high = vec3(end - beam.cell) - beam.fraction - beam.pad;
    const float x = leave_interval(beam.axis.x, beam.spread, first.x <= 0 ? -kBeamEnd : low.x,
                                   end.x >= size.x ? kBeamEnd : high.x, t);
    const float y = leave_interval(beam.axis.y, beam.spread, first.y <= 0 ? -kBeamEnd : low.y,
                                   end.y >= size.y ? kBeamEnd : high.y, t);
    const float z = leave_interval(beam.axis.z, beam.spread, first.z <= 0 ? -kBeamEnd : low.z,
                                   end.z >= size.z ? kBeamEnd : high.z, t);
    return min(x, min(y, z));
}

// Time before which no ray of the beam hits a solid cell: kUnbounded when none ever does, 0 when
// nothing is gained. Where the edge of the cross-section has reached the end of a box but its centre has not,
// the box of a cell further ahead may contain both.
VX_FN float beam_start(VX_WORLD_PARAM Beam beam, ivec3 chunks) {
    if (!(beam.spread < kWidestBeam)) return 0.0f;
    float t = 0.0f;
    bool ahead = false;
    for (uint step = 0u; step < kBeamSteps; ++step) {
        const float reach = ahead ? 1.5f * beam.spread * t + 1.0f : 0.0f;
        const ivec3 cell = ivec3(floor(beam.fraction + (t + reach) * beam.axis));
        const float exit = leave_box(VX_WORLD_ARG beam, cell, t, chunks);
        const bool gains = exit >= t + kBeamGain;
        if (!gains && ahead) break;
        ahead = !gains;
        if (gains) t = exit;
        if (t > 0.25f * kBeamEnd) return kUnbounded;
    }
    return t - t * kBeamError;
}

VX_END

#endif
