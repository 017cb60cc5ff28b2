#pragma once

#include <cstdint>

#include "passes/plane.h"
#include "shared/photon_types.h"

namespace voxilux {

// What the grid and the fixed-point scale of an iteration are derived from.
struct PhotonSetup {
    double radius = 0.0;         // of the gather kernel, voxels
    double extent = 0.0;         // largest magnitude of photon coordinates, which are local to the world
    glm::dvec3 max_power{0.0};   // largest power of a photon, watts
    std::uint32_t buckets = 0;   // a power of two
    std::uint32_t capacity = 0;  // photons that fit in the store
    std::uint32_t iteration = 1;
    double alpha = 2.0 / 3.0;  // for radii of pixels (PhotonRadii::own)
};

// The parameters of an iteration. The radius is at least kMinPhotonRadius, and the half-area radius is
// 1/sqrt(2) of it. A channel without power has scale 0.
[[nodiscard]] gpu::PhotonParams photon_params(const PhotonSetup& setup);

// Puts the parameters on the device and empties the store, before the pass that traces a run of photons.
void record_photon_clear(const RenderPlan& plan, const gpu::PhotonParams& params, Recording& recording);

// Marks the cells where photons are needed, before the pass that traces them: those that a kernel about a hit
// touches.
void record_photon_mark(const RenderPlan& plan, const DispatchTile& tile, const Plane& hits,
                        Recording& recording);

// Sorts the stored photons into buckets: photon.scan, photon.sort.
void record_photon_sort(const RenderPlan& plan, const gpu::PhotonParams& params, Recording& recording);

// Irradiance at each hit from the photons, vec3: for the image, and with the half-area radius.
struct PhotonPlanes {
    Plane light;
    Plane half_area;
};

// Which radius a gather uses: the iteration's, or each pixel's own, which starts at the iteration's and
// shrinks (persistent buffer photon.radii). In the latter case all iterations use the grid of the first
// radius.
enum class PhotonRadii { common, own };

// The irradiance at each hit from the sorted photons around it. The tile is the whole crop window.
[[nodiscard]] PhotonPlanes record_photon_gather(const RenderPlan& plan, const DispatchTile& tile,
                                                const Plane& hits, PhotonRadii radii, Recording& recording);

// The same for photons that come in runs: adds the sums of a run to the totals of the pixels, which
// record_photon_resolve turns into irradiance after the last run.
void record_photon_add(const RenderPlan& plan, const DispatchTile& tile, const Plane& hits, PhotonRadii radii,
                       Recording& recording);

// The same, to the bit, by splatting: photons look for the points around them. Photons need not be sorted
// (constant sorts_photons of the pass that stores them is 0), but the points are sorted for each run, and
// that also tells the splat how many photons there are.
void record_photon_points(const RenderPlan& plan, const gpu::PhotonParams& params, const DispatchTile& tile,
                          const Plane& hits, Recording& recording);
void record_photon_splat(const RenderPlan& plan, Recording& recording);

// Clears the totals, before the first run that adds to them.
void record_photon_totals(const RenderPlan& plan, PhotonRadii radii, Recording& recording);
[[nodiscard]] PhotonPlanes record_photon_resolve(const RenderPlan& plan, const DispatchTile& tile,
                                                 const Plane& hits, PhotonRadii radii, Recording& recording);

}  // namespace voxilux
