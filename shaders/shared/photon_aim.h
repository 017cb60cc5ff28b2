// Where photons of caustics start: in the cells of a grid behind which something bends or mirrors light. The
// grid lies over the disc of the sun, columns and rows in voxels, or over the directions of an emitter: a
// column is a part of a turn, and a row a part of the light that leaves at an angle. All cells of a grid send
// the same light. They are listed row by row, so that points of a sequence stay spread over both axes.
#ifndef VX_PHOTON_AIM_H
#define VX_PHOTON_AIM_H

#include "photon_types.h"
#include "portable.h"
#include "sampling.h"

VX_BEGIN

// A marked cell. `row_first` is the number of the first one of its row, counted from the map's first.
struct AimCell {
    uint row;
    uint column;
    uint row_count;  // marked cells of its row
    uint row_first;
};

// Rows and columns of a grid, at most: those of a cell have 8 bits each.
VX_CONST(uint, kAimEdge, 256u);

VX_FN uvec2 pack_aim_cell(AimCell cell) {
    return uvec2(cell.row | (cell.column << 8u) | (cell.row_count << 16u), cell.row_first);
}

VX_FN AimCell unpack_aim_cell(uvec2 words) {
    AimCell cell;
    cell.row = words.x & 255u;
    cell.column = (words.x >> 8u) & 255u;
    cell.row_count = words.x >> 16u;
    cell.row_first = words.y;
    return cell;
}

// The number of a cell of `count` > 0 that u in [0, 1) chooses.
VX_FN uint aim_number(float u, uint count) {
    VX_PRECISE float place = u * float(count);
    return min(uint(place), count - 1u);
}

// A point of the cell that u.y has chosen by its row and u.x in that row, `column` being its column.
VX_FN vec2 aim_point(AimMap map, AimCell row, uint column, vec2 u) {
    VX_PRECISE float across = u.x * float(row.row_count);
    across = across - float(aim_number(u.x, row.row_count));
    VX_PRECISE float along = u.y * float(map.count);
    along = (along - float(row.row_first)) / float(row.row_count);
    vec2 part = vec2(min(across, 1.0f), min(max(along, 0.0f), 1.0f));
    return map.low + map.cell * (vec2(float(column), float(row.row)) + part);
}

// What the marked cells cover: voxels^2 of the sun's disc, or the share of an emitter's light.
VX_FN float aim_area(AimMap map) {
    VX_PRECISE float cell = map.cell.x * map.cell.y;
    return float(map.count) * cell;
}

// Cosine and sine of a part of a turn in [0, 1].
VX_FN vec2 turned(float turn) {
    VX_PRECISE float quarters = 4.0f * turn;
    float whole = floor(quarters + 0.5f);
    vec2 sine_cosine = sin_cos_eighth(2.0f * (quarters - whole));
    uint quarter = uint(whole) & 3u;
    vec2 point = vec2(sine_cosine.y, sine_cosine.x);
    if ((quarter & 1u) != 0u) point = vec2(-point.y, point.x);
    return quarter >= 2u ? -point : point;
}

// Cosine-weighted direction around +z of a point of the unit square; z is at least 2^-12.
VX_FN vec3 aimed_cosine(vec2 point) {
    VX_PRECISE float z2 = max(1.0f - point.y, kUnitStep);
    VX_PRECISE float sine = sqrt(1.0f - z2);
    return vec3(sine * turned(point.x), sqrt(z2));
}

// Uniform direction of a point of the unit square.
VX_FN vec3 aimed_anywhere(vec2 point) {
    float y = min(point.y, 1.0f);
    VX_PRECISE float sine = 2.0f * sqrt(y * (1.0f - y));
    return vec3(sine * turned(point.x), 1.0f - 2.0f * y);
}

// Where a photon of the sun starts: a point of a plane that faces `towards`, from which the sun is seen.
struct AimedSun {
    vec3 towards;  // unit
    vec3 place;    // from the centre of the disc
};

// `point` counts in voxels along the axes of the disc, turned by the least rotation that makes it face
// `towards`; `radius` is the plane's distance from the centre. `height` is that of the sun's cone.
VX_FN AimedSun aimed_sun(vec3 direction, float height, vec2 u, vec2 point, float radius) {
    Basis disc = basis_around(direction);
    vec3 tilted = uniform_cone(vec3(0.0f, 0.0f, 1.0f), height, u);
    AimedSun aimed;
    aimed.towards = from_basis(disc, tilted);
    aimed.place = from_basis(disc, from_basis(basis_around(tilted), vec3(point, radius)));
    return aimed;
}

VX_END

#endif
