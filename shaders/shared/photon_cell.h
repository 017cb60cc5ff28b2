// How photons are stored so that a kernel finds them: sorted by cell into the buckets of a hash table. A row
// is a line of cells along x on one surface; its cells go into neighbouring buckets, so the part of a row
// that a box touches is one run of the sorted photons. A box as wide as a kernel touches at most two cells
// along y and along z; along x, cells are narrower, so that a run fits the kernel better.
//
// Different rows may share buckets: readers of a row skip the photons of others (photon_cell()), so each
// photon counts once, and images do not depend on the size of the table. Source: Hachisuka and Jensen 2010,
// "Parallel Progressive Photon Mapping on GPUs", for the hashed grid; rows are ours.
#ifndef VX_PHOTON_CELL_H
#define VX_PHOTON_CELL_H

#include "hash.h"
#include "limits.h"
#include "photon_types.h"
#include "portable.h"

VX_BEGIN

VX_CONST(uint, kNoSurface, 0xFFFFFFFFu);
VX_CONST(uint, kNoBucket, 0xFFFFFFFFu);  // of a slot in the store that holds no photon
VX_CONST(uint, kSphereSurface, 0x80000000u);
VX_CONST(uint, kInsideOfSphere, 0x40000000u);

// What a photon and a visible point must share: the sphere and its side, or the plane and the side of a
// voxel's face. Light therefore never leaks round an edge or through a wall, however thin. kNoSurface for a
// miss and inside a solid cell.
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

// Index of the cell of a coordinate. Monotonic in the coordinate, rounding included.
VX_FN int photon_cell(float coordinate, float cells_per_voxel) {
    VX_PRECISE float cell = floor(coordinate * cells_per_voxel);
    return int(min(max(cell, -kFarthestPhotonCell), kFarthestPhotonCell));
}

// Bucket of cell 0 of a row.
VX_FN uint photon_row(int y, int z, uint surface) {
    return pcg_hash(uint(y) + pcg_hash(uint(z) + pcg_hash(surface)));
}

// Key of a photon's cell, from which bucket and mark follow.
VX_FN uint photon_key(vec3 position, uint surface, PhotonGrid grid) {
    const int x = photon_cell(position.x, grid.x_cells_per_voxel);
    const int y = photon_cell(position.y, grid.cells_per_voxel);
    const int z = photon_cell(position.z, grid.cells_per_voxel);
    return photon_row(y, z, surface) + uint(x);
}

// Bucket of a photon.
VX_FN uint photon_bucket(vec3 position, uint surface, PhotonGrid grid) {
    return photon_key(position, surface, grid) & grid.mask;
}

// Mark of a cell: whether a visible point could gather photons in it. Cells may share a mark. There are more
// marks than buckets, because most cells of a room may be out of sight.
VX_FN uint photon_mark(uint key, PhotonGrid grid) {
    return key & ((grid.mask * kMarksPerBucket + (kMarksPerBucket - 1u)) | 31u);
}

// Neighbouring buckets, from `begin` to `end` - 1, as indices of the table of starts; a run that wraps
// continues at the table's beginning.
struct BucketRun {
    uint begin;
    uint end;
    bool wraps;
};

// The buckets of the cells x0 to x1 of a row, each once.
VX_FN BucketRun bucket_run(int y, int z, int x0, int x1, uint surface, PhotonGrid grid) {
    const uint size = grid.mask + 1u;
    const uint length = uint(x1 - x0) + 1u;
    const bool is_whole = length >= size;
    BucketRun run;
    run.begin = is_whole ? 0u : (photon_row(y, z, surface) + uint(x0)) & grid.mask;
    const uint end = run.begin + (is_whole ? size : length);
    run.wraps = end > size;
    run.end = run.wraps ? end - size : end;
    return run;
}

#ifdef __cplusplus
// 32-bit words that hold the marks for this many buckets.
inline std::uint32_t mark_words(std::uint32_t buckets) {
    return (buckets * kMarksPerBucket + 31) / 32;
}

// The grid for kernels of a radius in a world whose coordinates are at most `extent` > 0 in magnitude, with a
// power of two of buckets. Cells are wider than the kernel by 2^-20 of the extent, several roundings of a
// coordinate, so that a kernel never touches three of them along an axis, and there are fewer than 2^21 along
// an axis.
inline PhotonGrid photon_grid(float radius, float extent, std::uint32_t buckets) {
    const double width = 2.0 * radius * 1.001 + extent * 0x1p-20;
    return {.cells_per_voxel = static_cast<float>(1.0 / width),
            .x_cells_per_voxel = static_cast<float>(kPhotonCellParts / width),
            .mask = buckets - 1};
}
#endif

VX_END

#endif
