#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// Irradiance at each visible point from the photons around it, for two radii.

#include "lib/address.glsl"

#define VX_GROUP_2D
#include "lib/invocation.glsl"

#include "lib/frame_access.glsl"
#include "lib/photon_frame.glsl"
#include "lib/photon_light.glsl"

layout(scalar) readonly buffer Hits {
    Hit hits[];
};
layout(scalar) readonly buffer BucketStarts {
    uint bucket_starts[];
};
layout(scalar) readonly buffer SortedPlaces {
    uint64_t sorted_places[];
};
layout(scalar) readonly buffer SortedPowers {
    uint64_t sorted_powers[];
};

// The photons of up to four runs of buckets, numbered through: number n is photon n + offset of the run it falls in.
struct PhotonList {
    uvec4 ends;
    uvec4 offsets;
    uint total;  // photons in the store; numbers past it go on at its start
};

void add_run(inout PhotonList list, uint run, BucketRun buckets) {
    uint size = photon.grid.mask + 1u;
    uint end = buckets.first + buckets.count;
    uint first = bucket_starts[buckets.first];
    uint last = bucket_starts[end > size ? end - size : end] + (end > size ? list.total : 0u);
    uint before = run == 0u ? 0u : list.ends[run - 1u];
    list.ends[run] = before + (buckets.count > 0u ? last - first : 0u);
    list.offsets[run] = first - before;
}

PhotonList photons_near(vec3 position, uint surface) {
    BucketRuns runs = photon_runs(position, photon.radius, surface, photon.grid);
    PhotonList list;
    list.total = bucket_starts[photon.grid.mask + 1u];
    add_run(list, 0u, runs.a);
    add_run(list, 1u, runs.b);
    add_run(list, 2u, runs.c);
    add_run(list, 3u, runs.d);
    return list;
}

uint index_of(PhotonList list, uint n) {
    uint offset = n < list.ends.x   ? list.offsets.x
                  : n < list.ends.y ? list.offsets.y
                  : n < list.ends.z ? list.offsets.z
                                    : list.offsets.w;
    uint index = n + offset;
    return index >= list.total ? index - list.total : index;
}

// Adds the photons with the numbers first <= n < end, fewer than kPhotonBatch.
void add_batch(PhotonList list, uint first, uint end, vec3 position, uint surface, inout PhotonSums sums) {
    uvec3 wide = uvec3(0u);
    uvec3 narrow = uvec3(0u);
    float radius_squared = photon.radius * photon.radius;
    float narrow_squared = photon.narrow_radius * photon.narrow_radius;
    for (uint n = first; n < end; ++n) {
        uint i = index_of(list, n);
        uvec2 xy = unpack32(sorted_places[2u * i]);
        uvec2 zs = unpack32(sorted_places[2u * i + 1u]);
        float squared = photon_distance_squared(position, uintBitsToFloat(uvec3(xy, zs.x)));
        uvec3 power = uvec3(0u);
        if (zs.y == surface && squared <= radius_squared) power = unpack_power(unpack32(sorted_powers[i]));
        wide += power;
        narrow += squared <= narrow_squared ? power : uvec3(0u);
    }
    add_quanta(sums, wide, narrow);
}

void main() {
    Pixel pixel = this_pixel();
    if (!pixel.inside) return;
    Hit hit = hits[pixel.index];
    uint surface = photon_surface(hit);
    vec3 position = photon_position(hit);
    PhotonList list = photons_near(position, surface);
    uint count = surface == kNoSurface ? 0u : list.ends.w;
    PhotonSums sums = no_photons();
    for (uint first = 0u; first < count; first += kPhotonBatch)
        add_batch(list, first, min(first + kPhotonBatch, count), position, surface, sums);
    store_light(pixel.index, sums, 1.0);
}
