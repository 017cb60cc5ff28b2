// Where photons are kept so that a disc finds them: in the buckets of a hash table, sorted by bucket. A row
// is a line of cells along x on one surface; its cells go into neighbouring buckets, so that the part of a
// row which a disc touches is one run of the sorted photons. Cells are at least as wide as the disc along y
// and z, which therefore touches at most four rows, and narrow along x, where a run is cut to the disc.
//
// Different rows may share buckets. The runs of a disc are cut such that no bucket is visited twice; whoever
// reads them compares surface and distance, so pictures do not depend on the size of the table.
// Source: Hachisuka and Jensen 2010, "Parallel Progressive Photon Mapping on GPUs", for the hashed grid; rows
// and the cuts are ours.
#ifndef VX_PHOTON_CELL_H
#define VX_PHOTON_CELL_H

#include "hash.h"
#include "limits.h"
#include "photon_types.h"
#include "portable.h"

VX_BEGIN

VX_CONST(uint, kNoSurface, 0xFFFFFFFFu);
VX_CONST(uint, kSphereSurface, 0x80000000u);
VX_CONST(uint, kInsideOfSphere, 0x40000000u);

// What a photon and a visible point must share to meet: the sphere and its side, or the plane and the side of
// a voxel's face. Light so never leaks round an edge or through a wall, however thin. kNoSurface for a miss
// and inside of a solid cell.
VX_FN uint photon_surface(Hit hit) {
    if (hit.face == kFaceSphere) return kSphereSurface | hit.sphere;
    if (hit.face == kFaceSphereInside) return kSphereSurface | kInsideOfSphere | hit.sphere;
    if (hit.face >= kFaceInside) return kNoSurface;
    const uint axis = hit.face >> 1u;
    const int cell = axis == 0u ? hit.cell.x : (axis == 1u ? hit.cell.y : hit.cell.z);
    const uint plane = uint(cell) + (hit.face & 1u);
    return ((plane << 3u) | hit.face) & ~kSphereSurface;
}

// Position of a hit, local to the world.
VX_FN vec3 photon_position(Hit hit) {
    return vec3(hit.cell) + hit.fraction;
}

// Squared distance, the same bits in all passes.
VX_FN float photon_distance_squared(vec3 a, vec3 b) {
    VX_PRECISE float x = a.x - b.x;
    VX_PRECISE float y = a.y - b.y;
    VX_PRECISE float z = a.z - b.z;
    VX_PRECISE float squared = x * x + y * y + z * z;
    return squared;
}

// Number of the cell of a coordinate. It never falls while the coordinate rises, rounding included.
VX_FN int photon_cell(float coordinate, float cells_per_voxel) {
    VX_PRECISE float cell = floor(coordinate * cells_per_voxel);
    return int(min(max(cell, -kFarthestPhotonCell), kFarthestPhotonCell));
}

// Bucket of cell 0 of a row.
VX_FN uint photon_row(int y, int z, uint surface) {
    return pcg_hash(uint(y) + pcg_hash(uint(z) + pcg_hash(surface)));
}

// Bucket of a photon.
VX_FN uint photon_bucket(vec3 position, uint surface, PhotonGrid grid) {
    const int x = photon_cell(position.x, grid.x_cells_per_voxel);
    const int y = photon_cell(position.y, grid.cells_per_voxel);
    const int z = photon_cell(position.z, grid.cells_per_voxel);
    return (photon_row(y, z, surface) + uint(x)) & grid.mask;
}

// A run of buckets, which may go on at the table's start.
struct BucketRun {
    uint first;
    uint count;
};

// The runs of four rows.
struct BucketRuns {
    BucketRun a;
    BucketRun b;
    BucketRun c;
    BucketRun d;
};

// What is left of the run of `length` buckets from `home` on, of which `run` is a part, without the equally
// long run from `other` on. `length` is at most half the table.
VX_FN BucketRun cut_run(BucketRun run, uint home, uint other, uint length, uint mask) {
    const uint ahead = (home - other) & mask;
    const uint behind = (other - home) & mask;
    uint begin = (run.first - home) & mask;
    uint end = begin + run.count;
    if (ahead < length)
        begin = max(begin, length - ahead);
    else if (behind < length)
        end = min(end, behind);
    BucketRun left;
    left.first = (home + begin) & mask;
    left.count = end > begin ? end - begin : 0u;
    return left;
}

// The buckets of all photons of a surface that may lie within `radius` of a position, each once. `radius` is
// at most that of the grid.
VX_FN BucketRuns photon_runs(vec3 position, float radius, uint surface, PhotonGrid grid) {
    // Wider by more than the rounding of a distance. Subtraction rounds monotonically, so no photon that the
    // distance admits lies beyond.
    VX_PRECISE float reach = radius * kPhotonReach;
    const int x0 = photon_cell(position.x - reach, grid.x_cells_per_voxel);
    const int x1 = photon_cell(position.x + reach, grid.x_cells_per_voxel);
    const int y0 = photon_cell(position.y - reach, grid.cells_per_voxel);
    const int y1 = photon_cell(position.y + reach, grid.cells_per_voxel);
    const int z0 = photon_cell(position.z - reach, grid.cells_per_voxel);
    const int z1 = photon_cell(position.z + reach, grid.cells_per_voxel);
    const uint length = uint(x1 - x0) + 1u;
    BucketRuns runs;
    if (length > (grid.mask + 1u) / 2u) {
        runs.a.first = 0u;
        runs.a.count = grid.mask + 1u;
        runs.b = runs.a;
        runs.b.count = 0u;
        runs.c = runs.b;
        runs.d = runs.b;
        return runs;
    }
    const uint home_a = (photon_row(y0, z0, surface) + uint(x0)) & grid.mask;
    const uint home_b = (photon_row(y1, z0, surface) + uint(x0)) & grid.mask;
    const uint home_c = (photon_row(y0, z1, surface) + uint(x0)) & grid.mask;
    const uint home_d = (photon_row(y1, z1, surface) + uint(x0)) & grid.mask;
    // Rows that are the same have the same home, and the later ones are cut to nothing.
    runs.a.first = home_a;
    runs.a.count = length;
    runs.b.first = home_b;
    runs.b.count = length;
    runs.c.first = home_c;
    runs.c.count = length;
    runs.d.first = home_d;
    runs.d.count = length;
    runs.b = cut_run(runs.b, home_b, home_a, length, grid.mask);
    runs.c = cut_run(cut_run(runs.c, home_c, home_a, length, grid.mask), home_c, home_b, length, grid.mask);
    runs.d = cut_run(runs.d, home_d, home_a, length, grid.mask);
    runs.d = cut_run(runs.d, home_d, home_b, length, grid.mask);
    runs.d = cut_run(runs.d, home_d, home_c, length, grid.mask);
    return runs;
}

#ifdef __cplusplus
// The grid for discs of a radius in a world whose coordinates are at most `extent` > 0 in magnitude, and a
// power of two of buckets. Cells are wider than the disc by 2^-20 of the extent, several roundings of a
// coordinate, so that the ends of a disc never lie in three of them; and there are less than 2^21 along an
// axis.
inline PhotonGrid photon_grid(float radius, float extent, std::uint32_t buckets) {
    const double width = 2.0 * radius * 1.001 + extent * 0x1p-20;
    return {.cells_per_voxel = static_cast<float>(1.0 / width),
            .x_cells_per_voxel = static_cast<float>(kPhotonCellParts / width),
            .mask = buckets - 1};
}
#endif

VX_END

#endif
