#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// Adds each stored photon to the visible points around it: the sums of photon_gather, computed in the
// opposite direction.

#include "lib/address.glsl"
#extension GL_EXT_shader_atomic_int64 : require

#include "lib/invocation.glsl"

#include "lib/loops.glsl"
#include "lib/photon_frame.glsl"
#include "lib/photon_words.glsl"
#include "lib/counters_access.glsl"
#include "shared/photon_cell.h"
#include "shared/photon_power.h"

layout(scalar) readonly buffer PhotonHeads {
    PhotonHead head;
};
layout(scalar) readonly buffer StoredPhotons {
    uint64_t stored_words[];
};
layout(scalar) readonly buffer BucketStarts {
    uint bucket_starts[];
};
layout(scalar) readonly buffer SortedPoints {
    PhotonPoint sorted_points[];
};
layout(scalar) buffer PhotonTotals {
    uint64_t totals[];
};

void add(uint first, uvec3 quanta) {
    atomicAdd(totals[first], uint64_t(quanta.x));
    atomicAdd(totals[first + 1u], uint64_t(quanta.y));
    atomicAdd(totals[first + 2u], uint64_t(quanta.z));
}

// Adds a photon to the points in a row of cells. Rows may share buckets, so some points there belong to other
// rows.
void splat_row(SortedPhoton from, int y, int z) {
    float reach = photon.radius * kPhotonReach;
    int x0 = photon_cell(from.position.x - reach, photon.grid.x_cells_per_voxel);
    int x1 = photon_cell(from.position.x + reach, photon.grid.x_cells_per_voxel);
    BucketRun run = bucket_run(y, z, x0, x1, from.surface, photon.grid);
    uint total = bucket_starts[photon.grid.mask + 1u];
    uint first = bucket_starts[run.begin];
    uint points = bucket_starts[run.end] + (run.wraps ? total : 0u) - first;
    uvec3 quanta = unpack_power(from.power);
    for (uint n = 0u; n < points; ++n) {
        uint i = first + n;
        PhotonPoint point = sorted_points[i >= total ? i - total : i];
        float squared = photon_distance_squared(point.position, from.position);
        bool is_here = point.surface == from.surface &&
                       photon_cell(point.position.y, photon.grid.cells_per_voxel) == y &&
                       photon_cell(point.position.z, photon.grid.cells_per_voxel) == z;
        if (is_here && squared <= photon.radius * photon.radius) add(6u * point.pixel, quanta);
        if (is_here && squared <= photon.half_area_radius * photon.half_area_radius) add(6u * point.pixel + 3u, quanta);
    }
}

void main() {
    init_photons();
    uint i = linear_id();
    if (i >= min(head.count, photon.capacity)) return;
    uint word = kStoredWords * i;
    SortedPhoton from = photon_of_words(stored_words[word], stored_words[word + 1u], stored_words[word + 2u]);
    if (from.surface == kNoSurface) return;
    float reach = photon.radius * kPhotonReach;
    int y1 = photon_cell(from.position.y + reach, photon.grid.cells_per_voxel);
    int z1 = photon_cell(from.position.z + reach, photon.grid.cells_per_voxel);
    for (int z = photon_cell(from.position.z - reach, photon.grid.cells_per_voxel); z <= z1; ++z) {
        for (int y = photon_cell(from.position.y - reach, photon.grid.cells_per_voxel); y <= y1; ++y)
            splat_row(from, y, z);
    }
    count(kFaultLoopCut, are_loops_spent(2u + (i & 1u)) ? 1u : 0u);
}
