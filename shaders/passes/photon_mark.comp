#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// Marks the cells in which a photon could contribute to a visible point: those that its kernel touches.
// Photons elsewhere are not stored.

#define VX_GROUP_2D
#include "lib/invocation.glsl"

#include "lib/frame_access.glsl"
#include "lib/photon_frame.glsl"
#include "shared/photon_cell.h"

layout(scalar) readonly buffer Hits {
    Hit hits[];
};
layout(scalar) buffer WantedCells {
    uint wanted_cells[];  // a bit per mark
};

// Sets the marks of neighbouring cells of a row.
void mark_cells(uint first_key, uint cells) {
    uint key = first_key;
    uint left = cells;
    while (left > 0u) {
        uint mark = photon_mark(key, photon.grid);
        uint bit = mark & 31u;
        uint taken = min(left, 32u - bit);
        uint bits = (0xFFFFFFFFu >> (32u - taken)) << bit;
        // Most are already set, and a read costs less than an atomic.
        if ((~wanted_cells[mark >> 5u] & bits) != 0u) atomicOr(wanted_cells[mark >> 5u], bits);
        key += taken;
        left -= taken;
    }
}

void main() {
    init_photons();
    Pixel pixel = this_pixel();
    if (!pixel.inside) return;
    Hit hit = hits[pixel.index];
    uint surface = photon_surface(hit);
    if (surface == kNoSurface) return;
    vec3 point = photon_position(hit);
    float reach = photon.radius * kPhotonReach;
    vec3 low = point - reach;
    vec3 high = point + reach;
    int x0 = photon_cell(low.x, photon.grid.x_cells_per_voxel);
    int x1 = photon_cell(high.x, photon.grid.x_cells_per_voxel);
    int y1 = photon_cell(high.y, photon.grid.cells_per_voxel);
    int z1 = photon_cell(high.z, photon.grid.cells_per_voxel);
    for (int z = photon_cell(low.z, photon.grid.cells_per_voxel); z <= z1; ++z) {
        for (int y = photon_cell(low.y, photon.grid.cells_per_voxel); y <= y1; ++y)
            mark_cells(photon_row(y, z, surface) + uint(x0), uint(x1 - x0) + 1u);
    }
}
