#pragma once

#include <cstdint>

#include "passes/plane.h"
#include "shared/photon_types.h"

namespace voxilux {

// What the grid and the fixed point of an iteration are made for.
struct PhotonSetup {
    double radius = 0.0;         // of the gather, voxels
    double extent = 0.0;         // coordinates of photons, local to the world, are at most this in magnitude
    glm::dvec3 max_power{0.0};   // that a photon carries, watts
    std::uint32_t buckets = 0;   // a power of two
    std::uint32_t capacity = 0;  // photons that fit in the store
    std::uint32_t iteration = 1;
    double alpha = 2.0 / 3.0;  // of pixels with radii of their own
};

// The parameters of an iteration. The radius is not below kMinPhotonRadius, and the half-area one is
// 1/sqrt(2) of it. A channel without power gets none.
[[nodiscard]] gpu::PhotonParams photon_params(const PhotonSetup& setup);

// Puts the parameters on the device and empties the store, before the pass that traces a run of photons.
void record_photon_clear(const RenderPlan& plan, const gpu::PhotonParams& params, Recording& recording);

// Finds where photons are wanted, before the pass that traces them: the cells that a disc about a hit
// touches.
void record_photon_mark(const RenderPlan& plan, const DispatchTile& tile, const Plane& hits,
                        Recording& recording);

// Sorts the stored photons into buckets: photon.scan, photon.sort.
void record_photon_sort(const RenderPlan& plan, const gpu::PhotonParams& params, Recording& recording);

// Irradiance at each hit from the photons, vec3: as the picture takes it, and with the half-area radius.
struct PhotonPlanes {
    Plane light;
    Plane half_area;
};

// Whose radius a gather takes: the iteration's, or each pixel's own, which starts at the iteration's and
// shrinks (persistent buffer photon.radii). Then the grid is that of the first radius in all iterations.
enum class PhotonRadii { common, own };

// The irradiance at each hit from the sorted photons around it. The tile is the whole picture.
[[nodiscard]] PhotonPlanes record_photon_gather(const RenderPlan& plan, const DispatchTile& tile,
                                                const Plane& hits, PhotonRadii radii, Recording& recording);

// The same in runs of photons: their sums are added to the totals of the pixels, which record_photon_resolve
// turns into irradiance after the last run.
void record_photon_add(const RenderPlan& plan, const DispatchTile& tile, const Plane& hits, PhotonRadii radii,
                       Recording& recording);

// The same, to the bit, from photons that look for the points around them instead: `scatter`. Photons need
// not be sorted (constant sorts_photons of the pass that stores them is 0), but the points, for each run:
// that tells the splat how many photons there are, too.
void record_photon_points(const RenderPlan& plan, const gpu::PhotonParams& params, const DispatchTile& tile,
                          const Plane& hits, Recording& recording);
void record_photon_splat(const RenderPlan& plan, Recording& recording);

// Empties the totals, before the first run that adds to them.
void record_photon_totals(const RenderPlan& plan, PhotonRadii radii, Recording& recording);
[[nodiscard]] PhotonPlanes record_photon_resolve(const RenderPlan& plan, const DispatchTile& tile,
                                                 const Plane& hits, PhotonRadii radii, Recording& recording);

}  // namespace voxilux
