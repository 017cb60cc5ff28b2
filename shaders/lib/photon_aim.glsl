// Where photons start that are to meet mirrors or glass first (shared/photon_aim.h).
#ifndef VX_PHOTON_AIM_GLSL
#define VX_PHOTON_AIM_GLSL

#include "shared/photon_aim.h"

layout(scalar) readonly buffer AimMaps {
    AimMap aim_maps[];  // the first is that of the sun
};
layout(scalar) readonly buffer AimCells {
    uvec2 aim_cells[];
};
layout(scalar) readonly buffer LightMaps {
    uint light_maps[];
};

AimMap map_of_light(uint number) {
    return aim_maps[light_maps[number]];
}

// A point of the marked cells of a map, each as likely.
vec2 aimed_point(AimMap map, vec2 u) {
    AimCell row = unpack_aim_cell(aim_cells[map.first + aim_number(u.y, map.count)]);
    uint place = map.first + row.row_first + aim_number(u.x, row.row_count);
    return aim_point(map, row, unpack_aim_cell(aim_cells[place]).column, u);
}

#endif
