#include "passes/photons/photons.h"

#include <algorithm>

#include "passes/photons/photon_trace.h"
#include "shared/sppm.h"

namespace voxilux {

PhotonPlanes record_photons(const RenderPlan& plan, const DispatchTile& tile, const Plane& hits,
                            std::uint32_t iteration, Recording& recording) {
    if (!plan.photons.runs()) return {constant_value(0.0f, recording), constant_value(0.0f, recording)};
    const PhotonSettings& settings = plan.settings.photons;
    const double radius = settings.classic
                              ? plan.photons.radius
                              : gpu::photon_radius(plan.photons.radius, settings.alpha, iteration);
    gpu::PhotonParams params = photon_params({.radius = radius,
                                              .extent = plan.world.lights.extent,
                                              .max_power = plan.photons.max_power,
                                              .buckets = plan.photons.buckets,
                                              .capacity = plan.photons.capacity,
                                              .iteration = iteration,
                                              .alpha = settings.alpha});
    const PhotonRadii radii = settings.classic && !settings.scatter ? PhotonRadii::own : PhotonRadii::common;
    const bool adds_up = settings.scatter || plan.photons.run_count() > 1;
    for (std::uint32_t first = 0; first < plan.photons.count(); first += plan.photons.at_once) {
        params.first_photon = first;
        params.photons = std::min(plan.photons.at_once, plan.photons.count() - first);
        record_photon_clear(plan, params, recording);
        if (first == 0) record_photon_mark(plan, tile, hits, recording);
        record_photon_emit(plan, recording);
        record_photon_trace(plan, recording);
        if (settings.scatter) record_photon_points(plan, params, tile, hits, recording);
        if (first == 0 && adds_up) record_photon_totals(plan, radii, recording);
        if (settings.scatter) {
            record_photon_splat(plan, recording);
            continue;
        }
        record_photon_sort(plan, params, recording);
        if (!adds_up) return record_photon_gather(plan, tile, hits, radii, recording);
        record_photon_add(plan, tile, hits, radii, recording);
    }
    return record_photon_resolve(plan, tile, hits, radii, recording);
}

}  // namespace voxilux
