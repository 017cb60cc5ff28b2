#include "passes/photons/photons.h"

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
    const gpu::PhotonParams params = photon_params({.radius = radius,
                                                    .extent = plan.world.lights.extent,
                                                    .max_power = plan.photons.max_power,
                                                    .buckets = plan.photons.buckets,
                                                    .capacity = plan.photons.capacity,
                                                    .iteration = iteration,
                                                    .alpha = settings.alpha});
    record_photon_clear(plan, params, recording);
    record_photon_mark(plan, tile, hits, recording);
    record_photon_emit(plan, recording);
    record_photon_trace(plan, recording);
    if (settings.scatter) return record_photon_splat(plan, params, tile, hits, recording);
    record_photon_sort(plan, params, recording);
    return record_photon_gather(plan, tile, hits, settings.classic ? PhotonRadii::own : PhotonRadii::common,
                                recording);
}

}  // namespace voxilux
