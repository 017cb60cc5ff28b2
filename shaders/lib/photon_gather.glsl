// The sums of photons around the visible points of a subgroup. Points of one surface that are near each other
// gather together: each invocation fetches a photon, and photons that may matter are broadcast to all of them
// in turn. Each photon is then loaded once per subgroup, which halves the time on software devices, where
// loads cost most. Include lib/address.glsl, lib/frame_access.glsl and lib/photon_resolve.glsl first.
#ifndef VX_PHOTON_GATHER_GLSL
#define VX_PHOTON_GATHER_GLSL

#extension GL_KHR_shader_subgroup_vote : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_shuffle : require

#include "lib/constants.glsl"
#include "lib/loops.glsl"
#include "lib/photon_light.glsl"
#include "lib/photon_words.glsl"
#include "lib/counters_access.glsl"

// Invocations of a subgroup that fetch photons, a power of two; 0 where the host does not know the subgroup
// size. A known size unrolls loops over them, which makes gathering 1/7 faster on lavapipe.
VX_SPECIALIZED(uint, known_lanes, 0u);

const uint kSpan = 2048u;  // photons of less than 2^21 quanta that fit a 32-bit sum; a multiple of the lanes
const uint kLaneBits = 5u;  // at most 32 invocations fetch

// Invocations that fetch, the same for a whole subgroup.
uint fetching_lanes = known_lanes;

void count_lanes() {
    if (known_lanes == 0u)
        fetching_lanes = min(subgroupBallotBitCount(subgroupBallot(true)), 1u << kLaneBits);
}

layout(scalar) readonly buffer BucketStarts {
    uint bucket_starts[];
};
layout(scalar) readonly buffer SortedPhotons {
    uint64_t sorted_words[];
};

// The pixel of an invocation in a list of 8x8 tiles; eight consecutive invocations are a block of 4x2 pixels.
Pixel tile_pixel() {
    uint tile = linear_id() / 64u;
    uint tiles_x = (frame.column_count + 7u) / 8u;
    uint tiles_y = (frame.row_count + 7u) / 8u;
    uint lane = gl_LocalInvocationID.x % 64u;
    uint x = (lane & 3u) | ((lane >> 1u) & 4u);
    uint y = ((lane >> 2u) & 1u) | ((lane >> 3u) & 6u);
    uint column = (tile % tiles_x) * 8u + x;
    uint row = interleaved_row(tile / tiles_x, tiles_y) * 8u + y;
    Pixel pixel;
    pixel.x = frame.first_column + column;
    pixel.y = frame.first_row + row;
    pixel.index = row * frame.column_count + column;
    pixel.inside = tile < tiles_x * tiles_y && column < frame.column_count && row < frame.row_count;
    return pixel;
}

// Points that gather together, the same for a whole subgroup. The box contains their kernels.
struct GatherBox {
    vec3 low;
    vec3 high;
    uint surface;
};

// A row of cells of a box, and where the photons of its buckets are; they may wrap around to the start of the
// store.
struct GatherRow {
    int y;
    int z;
    uint first;
    uint count;
};

// Row `number` of a box, which has `columns` rows side by side along y.
GatherRow gather_row(GatherBox box, uint number, uint columns, uint total) {
    GatherRow row;
    row.y = photon_cell(box.low.y, photon.grid.cells_per_voxel) + int(number % columns);
    row.z = photon_cell(box.low.z, photon.grid.cells_per_voxel) + int(number / columns);
    int x0 = photon_cell(box.low.x, photon.grid.x_cells_per_voxel);
    int x1 = photon_cell(box.high.x, photon.grid.x_cells_per_voxel);
    BucketRun run = bucket_run(row.y, row.z, x0, x1, box.surface, photon.grid);
    row.first = bucket_starts[run.begin];
    row.count = bucket_starts[run.end] + (run.wraps ? total : 0u) - row.first;
    return row;
}

// Whether a photon is in the box and in this row. Rows may share buckets, so a photon counts only in its own
// row.
bool is_in_row(GatherBox box, int y, int z, SortedPhoton found) {
    bool is_inside =
        all(greaterThanEqual(found.position, box.low)) && all(lessThanEqual(found.position, box.high));
    return is_inside && found.surface == box.surface &&
           photon_cell(found.position.y, photon.grid.cells_per_voxel) == y &&
           photon_cell(found.position.z, photon.grid.cells_per_voxel) == z;
}

// Rows, one for each invocation of a subgroup, and their photons numbered consecutively.
struct GatherList {
    GatherRow row;
    uint end;    // photons in the rows up to this one
    uint count;  // in all rows
    uint total;  // photons in the store
};

// A photon that an invocation has fetched for its subgroup.
struct Fetched {
    vec3 position;  // out of reach where no point of the box needs it
    uvec3 quanta;
};

Fetched fetch_photon(GatherBox box, GatherList list, uint n) {
    uint at = 0u;  // the invocation whose row holds photon n
    for (uint bit = kLaneBits; bit > 0u; --bit) {
        uint step = 1u << (bit - 1u);
        uint next = subgroupShuffle(list.end, (at + step - 1u) & (fetching_lanes - 1u));
        at += step < fetching_lanes && n >= next ? step : 0u;
    }
    uint i = subgroupShuffle(list.row.first + list.row.count - list.end, at) + n;
    i = i >= list.total ? i - list.total : i;
    uint word = kSortedWords * (n < list.count ? i : 0u);
    SortedPhoton found =
        photon_of_words(sorted_words[word], sorted_words[word + 1u], sorted_words[word + 2u]);
    int y = subgroupShuffle(list.row.y, at);
    int z = subgroupShuffle(list.row.z, at);
    Fetched fetched;
    fetched.position = n < list.count && is_in_row(box, y, z, found) ? found.position : vec3(kUnbounded);
    fetched.quanta = unpack_power(found.power);
    return fetched;
}

// Adds photons `first` to `end` - 1 of a list to the sums of the points that take part.
void add_span(GatherBox box, GatherList list, uint first, uint end, vec3 point, Discs discs, inout PhotonSums sums) {
    uvec3 wide = uvec3(0u);
    uvec3 half_area = uvec3(0u);
    for (uint at = first; at < end; at += fetching_lanes) {
        Fetched fetched = fetch_photon(box, list, at + gl_SubgroupInvocationID);
        for (uint from = 0u; from < fetching_lanes; ++from) {
            float squared = photon_distance_squared(point, subgroupShuffle(fetched.position, from));
            uvec3 quanta = subgroupShuffle(fetched.quanta, from);
            wide += squared <= discs.squared ? quanta : uvec3(0u);
            if (own_radii != 0u) sums.met += squared <= discs.squared ? 1u : 0u;
            half_area += squared <= discs.half_area_squared ? quanta : uvec3(0u);
        }
    }
    add_quanta(sums, wide, half_area);
}

// Splits the list into spans whose sums fit 32 bits.
void add_list(GatherBox box, GatherList list, vec3 point, Discs discs, inout PhotonSums sums) {
    for (uint first = 0u; first < list.count; first += kSpan)
        add_span(box, list, first, min(first + kSpan, list.count), point, discs, sums);
}

// Cells of a box along y or z.
uint cells_between(float low, float high) {
    int cells =
        photon_cell(high, photon.grid.cells_per_voxel) - photon_cell(low, photon.grid.cells_per_voxel) + 1;
    return uint(max(cells, 0));  // 0 for an empty box
}

// Adds the photons of a box. Its rows are looked up in parallel, one per invocation.
void add_box(GatherBox box, vec3 point, Discs discs, inout PhotonSums sums) {
    uint columns = cells_between(box.low.y, box.high.y);
    uint rows = columns * cells_between(box.low.z, box.high.z);
    GatherList list;
    list.total = bucket_starts[photon.grid.mask + 1u];
    for (uint first = 0u; first < rows; first += fetching_lanes) {
        uint number = first + gl_SubgroupInvocationID;
        list.row = gather_row(box, number, columns, list.total);
        list.row.count = number < rows && gl_SubgroupInvocationID < fetching_lanes ? list.row.count : 0u;
        list.end = subgroupInclusiveAdd(list.row.count);
        list.count = subgroupShuffle(list.end, fetching_lanes - 1u);
        add_list(box, list, point, discs, sums);
    }
}

// The sums at a point; zero for kNoSurface. All invocations of a subgroup must call it together.
PhotonSums gather(vec3 position, uint surface, Discs own) {
    count_lanes();
    PhotonSums sums = no_photons();
    float reach = photon.radius * kPhotonReach;
    bool waits = surface != kNoSurface;
    while (subgroupAny(waits)) {  // at least one fewer waits after each turn
        uint leader = subgroupBallotFindLSB(subgroupBallot(waits));
        GatherBox box;
        box.surface = subgroupShuffle(surface, leader);
        vec3 away = abs(position - subgroupShuffle(position, leader));
        bool takes = waits && surface == box.surface &&
                     max(max(away.x, away.y), away.z) <= kGatherSpread * photon.radius;
        box.low = subgroupMin(takes ? position : vec3(kUnbounded)) - reach;
        box.high = subgroupMax(takes ? position : vec3(-kUnbounded)) + reach;
        Discs discs;  // of the points that take part
        discs.squared = takes ? own.squared : -1.0;
        discs.half_area_squared = takes ? own.half_area_squared : -1.0;
        add_box(box, position, discs, sums);
        waits = waits && !takes && gl_SubgroupInvocationID != leader;
    }
    count(kFaultLoopCut, are_loops_spent(gl_SubgroupSize) && surface != kNoSurface ? 1u : 0u);
    return sums;
}

#endif
