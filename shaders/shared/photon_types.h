// Structs of photon mapping that live in device buffers, with the layout rules of gpu_types.h.
#ifndef VX_PHOTON_TYPES_H
#define VX_PHOTON_TYPES_H

#include "gpu_types.h"
#include "portable.h"

VX_BEGIN

// How positions are sorted into buckets (photon_cell.h).
struct PhotonGrid {
    float cells_per_voxel;    // along y and z
    float x_cells_per_voxel;  // along x
    uint mask;                // buckets of the table minus one
};

// What the passes of one iteration share in addition to FrameParams: the uniform block PhotonFrame.
struct PhotonParams {
    PhotonGrid grid;
    vec3 power_scale;        // quanta per watt, of red, green and blue (photon_power.h)
    vec3 power_unit;         // watts per quantum
    float radius;            // of the kernel, voxels
    float half_area_radius;  // of the second kernel, from which the bias follows; at most the first
    uint capacity;           // photons that fit in the store
    uint first_photon;       // of those that are traced and gathered together
    uint photons;            // number of these
    uint iteration;          // from 1
    float alpha;             // fraction of the new photons that a pixel with a radius of its own keeps
};

// The radius of a pixel that shrinks with the photons it has gathered (sppm.h).
struct PixelRadius {
    float squared;  // voxels^2
    float photons;  // gathered photons, weighted
};

// A photon where it hit a diffuse surface, as it is gathered.
struct SortedPhoton {
    vec3 position;  // local to the world, voxels
    uint surface;   // photon_surface()
    uvec2 power;    // packed (photon_power.h)
};

// The same as it is stored, with its sort key.
struct StoredPhoton {
    vec3 position;
    uint surface;
    uvec2 power;
    uint bucket;
    uint rank;  // index within the bucket, in order of arrival
};

// Marked cells of a grid, towards which photons start (photon_aim.h).
struct AimMap {
    uint first;  // of them, in the list of all maps
    uint count;
    vec2 low;   // corner of the grid, across and along
    vec2 cell;  // size of a cell
};

// Their sizes in 64-bit words, by which shaders read and write them.
VX_CONST(uint, kSortedWords, 3u);
VX_CONST(uint, kStoredWords, 4u);

#ifdef __cplusplus
static_assert(sizeof(SortedPhoton) == 8 * kSortedWords);
static_assert(sizeof(StoredPhoton) == 8 * kStoredWords);
#endif

// A visible point for splatting.
struct PhotonPoint {
    vec3 position;  // local to the world, voxels
    uint surface;   // photon_surface()
    uint pixel;     // of the tile
};

// Head of the store: the workgroups of passes over all photons in it, as an indirect dispatch reads them, and
// how many slots were requested, also beyond the capacity.
struct PhotonHead {
    uint groups_x;
    uint groups_y;
    uint groups_z;
    uint count;
};

// Buckets that one invocation of the prefix sum processes. 2^22 buckets make 2^16 runs, 1024 for each
// invocation that turns their sums into prefix sums.
VX_CONST(uint, kScanRun, 64u);

// Runs of a prefix sum over this many buckets.
VX_FN uint scan_runs(uint buckets) {
    return (buckets + kScanRun - 1u) / kScanRun;
}

VX_END

#endif
