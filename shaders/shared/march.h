// The march of a ray through a world of voxels, exact by construction in every structure (world_cell.h).
//
// A ray starts in an integer cell at a fraction in [0,1]^3 of it. Let T_a(j) be the float time at which it
// crosses its j-th plane of axis a. One fixed `precise` expression computes T_a(j), and it never decreases
// with j, so sorting all crossings by (T, axis) gives one walk through the cells, whatever structure is
// marched. A box of empty cells is left at its earliest exit plane, and the cell on the other two axes is the
// number of planes whose (T, axis) comes before: estimated from the position, then corrected by comparing one
// T. So every traversal visits the same cells as the plain voxel-by-voxel walk, and no epsilon is needed.
// (Incremental walk: Amanatides & Woo 1987.)
//
// Tie rule: a ray crosses one face at a time; where it meets an edge or a corner exactly it crosses x before
// y before z. So each walk is 6-connected: no ray slips between two solids that touch along an edge, and a
// shell that a 6-connected walk cannot leave is light-tight. A cell owns its low faces; a ray in a face plane
// is in the upper cell. Times are equal when their floats are: that is so for planes met at 0 and for equal
// times whose speeds are in a ratio of a power of two; of others within rounding the floats decide, in every
// structure alike.
//
// The including side provides what find_cell.h asks for.
#ifndef VX_MARCH_H
#define VX_MARCH_H

#include "find_cell.h"
#include "gpu_types.h"
#include "limits.h"
#include "portable.h"

VX_BEGIN

// Constants of a ray. Axis a advances by planes: after n crossings the ray is in cell[a] + n or cell[a] - n.
// `sign_mask` is 0 for directions >= 0 and -1 below, so (n ^ sign_mask) - sign_mask is the signed step.
struct MarchAxes {
    ivec3 cell;  // of the start
    ivec3 sign_mask;
    vec3 speed;               // |direction|, 0 where it counts as zero
    vec3 inverse_direction;   // 1 / speed, or kNeverCrossed
    vec3 offset;              // T(j) = (j + sign_mask + offset) * inverse_direction
    ivec3 direction_numbers;  // index of the ray's direction -x +x -y +y -z +z on each axis
    ivec3 far_shift;  // where its distances start in fields of kFarBits; in fields of kNearBits at twice
                      // `direction_numbers`
};

VX_CONST(uint, kMarchFine, 0u);
VX_CONST(uint, kMarchUnsound, 1u);    // the ray is not finite or has no direction: a miss
VX_CONST(uint, kMarchExhausted, 2u);  // the step limit ended the march

struct MarchHit {
    ivec3 cell;  // solid cell, local to the world
    uint face;   // 0..5 = -x +x -y +y -z +z, kFaceInside, or kFaceMiss
    float t;     // entry time in units of the direction's length
    uint material;
    ivec3 crossed;  // planes crossed per axis
    uint steps;
    uint fault;  // kMarch*
};

// Whether a ray can be marched: finite, with a direction. Tests the bits, because drivers fold tests such as
// x - x.
VX_FN bool is_sound(Ray ray) {
    const vec3 d = ray.direction;
    const vec3 f = ray.fraction;
    const uint largest = max(max(max(floatBitsToUint(d.x) & 0x7FFFFFFFu, floatBitsToUint(d.y) & 0x7FFFFFFFu),
                                 floatBitsToUint(d.z) & 0x7FFFFFFFu),
                             max(max(floatBitsToUint(f.x) & 0x7FFFFFFFu, floatBitsToUint(f.y) & 0x7FFFFFFFu),
                                 floatBitsToUint(f.z) & 0x7FFFFFFFu));
    const bool has_direction = max(max(abs(d.x), abs(d.y)), abs(d.z)) >= kMinDirection;
    return largest < 0x7F800000u && has_direction;
}

// -1 below 0, else 0. Only the bits of what is below 0, not of -0, keep their highest when 1 is taken away.
VX_FN int sign_mask_of(float x) {
    return int(max(floatBitsToUint(x), 1u) - 1u) >> 31;
}

VX_FN MarchAxes march_axes(Ray ray) {
    const vec3 d = ray.direction;
    const vec3 speed = abs(d);
    const vec3 used = vec3(speed.x < kMinDirection ? 0.0f : 1.0f, speed.y < kMinDirection ? 0.0f : 1.0f,
                           speed.z < kMinDirection ? 0.0f : 1.0f);
    MarchAxes axes;
    axes.cell = ray.cell;
    axes.speed = speed * used;
    // Bits and products: what comparisons choose, software devices make anew in each turn of the loop.
    axes.sign_mask =
        ivec3(sign_mask_of(d.x * used.x), sign_mask_of(d.y * used.y), sign_mask_of(d.z * used.z));
    // A speed of 1 in place of 0, since 1 / 0 is infinite; kNeverCrossed by a product.
    VX_PRECISE vec3 inverse =
        (1.0f / (speed * used + (1.0f - used))) * (used + (1.0f - used) * kNeverCrossed);
    axes.inverse_direction = inverse;
    axes.offset = ray.fraction * used * vec3(-1 - 2 * axes.sign_mask);
    axes.direction_numbers = ivec3(1, 3, 5) + axes.sign_mask;
    axes.far_shift = axes.direction_numbers * int(kFarBits);
    return axes;
}

// Index of the direction that the ray takes on an axis.
VX_FN int direction_number(MarchAxes axes, int axis) {
    return axis == 0 ? axes.direction_numbers.x
                     : (axis == 1 ? axes.direction_numbers.y : axes.direction_numbers.z);
}

// Times at which plane j of each axis is crossed. The only place where such a time is computed.
VX_FN vec3 plane_times(MarchAxes axes, ivec3 j) {
    VX_PRECISE vec3 t = (vec3(j + axes.sign_mask) + axes.offset) * axes.inverse_direction;
    return t;
}

// First of three crossings in the order (time, axis).
struct NextCrossing {
    int axis;
    float t;
};

VX_FN NextCrossing first_crossing(vec3 t) {
    const bool z_before_y = t.z < t.y;
    const float yz = z_before_y ? t.z : t.y;
    const bool yz_before_x = yz < t.x;
    NextCrossing first;
    first.axis = yz_before_x ? (z_before_y ? 2 : 1) : 0;
    first.t = yz_before_x ? yz : t.x;
    return first;
}

// The cell of a ray after these crossings.
VX_FN ivec3 cell_behind(MarchAxes axes, ivec3 crossed) {
    return axes.cell + (crossed ^ axes.sign_mask) - axes.sign_mask;
}

// Crossings of each axis up to that of `axis` at `t`, which is one of them. The estimate is low by at most
// one: kPlaneMargin exceeds its rounding error.
VX_FN ivec3 planes_until(MarchAxes axes, float t, int axis) {
    const vec3 estimate = t * axes.speed - axes.offset - vec3(axes.sign_mask) - kPlaneMargin;
    ivec3 n = ivec3(estimate);  // 0 also of what is slightly below
    const vec3 next = plane_times(axes, n + 1);
    n.x += next.x <= t ? 1 : 0;
    n.y += next.y < t || (next.y == t && axis > 0) ? 1 : 0;
    n.z += next.z < t || (next.z == t && axis > 1) ? 1 : 0;
    return n;
}

// Planes to cross on each axis to leave the empty box around `local`, counted from the start.
VX_FN ivec3 planes_to_exit(MarchCell found, ivec3 local, MarchAxes axes) {
    const uint ones = (1u << found.bits) - 1u;
    const uint payload = cell_payload(found.cell);
    const ivec3 shift =
        found.bits == kFarBits ? axes.far_shift : axes.direction_numbers + axes.direction_numbers;
    const ivec3 extent = ivec3(int((payload >> uint(shift.x)) & ones), int((payload >> uint(shift.y)) & ones),
                               int((payload >> uint(shift.z)) & ones));
    const ivec3 home = (local ^ axes.sign_mask) >> found.log2;  // cells along the ray
    return ((home + extent + 1) << found.log2) - (axes.cell ^ axes.sign_mask);
}

// Planes to cross on each axis to leave the world from inside.
VX_FN ivec3 planes_to_border(MarchAxes axes, ivec3 size) {
    return ivec3(axes.sign_mask.x < 0 ? axes.cell.x + 1 : size.x - axes.cell.x,
                 axes.sign_mask.y < 0 ? axes.cell.y + 1 : size.y - axes.cell.y,
                 axes.sign_mask.z < 0 ? axes.cell.z + 1 : size.z - axes.cell.z);
}

// The hit of march() for a ray that is known to hit no solid cell before the time `start`: it steps from
// there, up to t_max or the crossing that leaves the world, whichever comes first. The loop has one way out
// and changes few values, because software devices blend each of them for all invocations, at each way out.
// (Its limit is not the same for all rays: that would be another bound of the loop for each world, and
// lavapipe would compile the march anew for each dispatch.)
VX_FN MarchHit march_from(VX_WORLD_PARAM Ray ray, ivec3 chunks, float start) {
    const MarchAxes axes = march_axes(ray);
    const ivec3 size = chunks << kChunkLog2;
    MarchHit hit;
    hit.face = kFaceMiss;
    hit.t = 0.0f;
    hit.material = 0u;
    hit.crossed = ivec3(0);
    hit.fault = is_sound(ray) ? kMarchFine : kMarchUnsound;
    const ivec3 border = planes_to_border(axes, size);
    NextCrossing last = first_crossing(plane_times(axes, border));
    const float from = max(start, 0.0f);
    const bool sets_out =
        hit.fault == kMarchFine && !is_outside(ray.cell, size) && from < ray.t_max && from <= last.t;
    const uint limit = sets_out ? uint(border.x + border.y + border.z) + kMarchSlack : 0u;
    if (ray.t_max <= last.t) {
        last.t = ray.t_max;
        last.axis = 0;
    }
    // Crossings before `start` are those up to the float below it.
    if (sets_out && from > 0.0f)
        hit.crossed = planes_until(axes, uintBitsToFloat(floatBitsToUint(from) - 1u), 2);
    int axis = -1;
    uint cell = make_cell(kCellEmpty, 0u);
    for (hit.steps = 0u; hit.steps < limit; ++hit.steps) {
        const ivec3 local = cell_behind(axes, hit.crossed);
        const MarchCell found = find_cell(VX_WORLD_ARG local, chunks);
        const NextCrossing next = first_crossing(plane_times(axes, planes_to_exit(found, local, axes)));
        const bool is_last = !(next.t < last.t || (next.t == last.t && next.axis < last.axis));
        cell = found.cell;
        if (cell_state(cell) == kCellSolid || is_last) break;
        axis = next.axis;
        hit.t = next.t;
        hit.crossed = planes_until(axes, hit.t, axis);
    }
    hit.cell = cell_behind(axes, hit.crossed);
    if (hit.steps == limit && limit != 0u) {
        hit.fault = kMarchExhausted;
    } else if (cell_state(cell) == kCellSolid) {
        hit.face = axis < 0 ? kFaceInside : uint(direction_number(axes, axis) ^ 1);
        hit.material = cell_payload(cell);
    }
    return hit;
}

// First solid cell along the ray whose entry time is below ray.t_max; a solid start cell is a hit at 0, and
// an empty interval (t_max not above 0) is a miss. The world has `chunks` chunks per axis. Each step crosses
// at least one plane, so the step limit is never reached in a valid world.
VX_FN MarchHit march(VX_WORLD_PARAM Ray ray, ivec3 chunks) {
    return march_from(VX_WORLD_ARG ray, chunks, 0.0f);
}

// Position of a hit inside its cell, [0,1]^3: exactly 0 or 1 on the axis of the face. The subtrahend is a
// single rounding, which a mirrored ray shares, so mirrored hits have mirrored fractions.
VX_FN vec3 hit_fraction(Ray ray, MarchHit hit) {
    const MarchAxes axes = march_axes(ray);
    VX_PRECISE vec3 passed = hit.t * axes.speed - (vec3(hit.crossed + axes.sign_mask) + axes.offset);
    const vec3 along = clamp(passed, vec3(0.0f), vec3(1.0f));
    const float on_face = float(hit.face & 1u);
    vec3 fraction;
    fraction.x = axes.speed.x == 0.0f ? ray.fraction.x : (axes.sign_mask.x < 0 ? 1.0f - along.x : along.x);
    fraction.y = axes.speed.y == 0.0f ? ray.fraction.y : (axes.sign_mask.y < 0 ? 1.0f - along.y : along.y);
    fraction.z = axes.speed.z == 0.0f ? ray.fraction.z : (axes.sign_mask.z < 0 ? 1.0f - along.z : along.z);
    const uint a = hit.face >> 1u;
    return vec3(a == 0u ? on_face : fraction.x, a == 1u ? on_face : fraction.y,
                a == 2u ? on_face : fraction.z);
}

// Where a ray that leaves the surface starts: the cell in front of the face, with the position on the face.
VX_FN Ray spawn_ray(ivec3 cell, uint face, vec3 fraction, vec3 direction, float t_max) {
    const uint a = face >> 1u;
    const int outward = int(face & 1u) * 2 - 1;
    const float behind = 1.0f - float(face & 1u);
    Ray ray;
    ray.cell = cell + ivec3(a == 0u ? outward : 0, a == 1u ? outward : 0, a == 2u ? outward : 0);
    ray.fraction =
        vec3(a == 0u ? behind : fraction.x, a == 1u ? behind : fraction.y, a == 2u ? behind : fraction.z);
    ray.direction = direction;
    ray.t_max = t_max;
    return ray;
}

VX_END

#endif
