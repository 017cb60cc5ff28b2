#include "passes/photon.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "shared/photon_cell.h"
#include "shared/photon_power.h"

namespace voxilux {
namespace {

// One of the three dispatches of the prefix sum, over `count` runs.
void record_scan_level(const RenderPlan& plan, std::uint32_t level, std::uint32_t count,
                       Recording& recording) {
    recording.dispatch({.label = "photon.scan",
                        .shader = "photon_scan",
                        .extent = {count, 1, 1},
                        .bindings = {{"PhotonFrame", use_buffer(plan, "photon.frame", recording)},
                                     {"Tally", use_buffer(plan, "tally", recording)},
                                     {"PhotonHeads", use_buffer(plan, "photon.head", recording)},
                                     {"BucketCounts", use_buffer(plan, "photon.counts", recording)},
                                     {"BucketRunSums", use_buffer(plan, "photon.runs", recording)},
                                     {"BucketStarts", use_buffer(plan, "photon.starts", recording)}},
                        .constants = {{"level", level}}});
}

void record_photon_scan(const RenderPlan& plan, const gpu::PhotonParams& params, Recording& recording) {
    const std::uint32_t runs = gpu::scan_runs(params.grid.mask + 1);
    record_scan_level(plan, 0, runs, recording);
    record_scan_level(plan, 1, gpu::kLinearGroup, recording);
    record_scan_level(plan, 2, runs, recording);
}

}  // namespace

gpu::PhotonParams photon_params(const PhotonSetup& setup) {
    VX_ASSERT(std::has_single_bit(setup.buckets));
    const double radius = std::max(setup.radius, static_cast<double>(gpu::kLeastPhotonRadius));
    gpu::PhotonParams params{};
    params.radius = static_cast<float>(radius);
    params.narrow_radius = static_cast<float>(radius / std::numbers::sqrt2);
    params.grid = gpu::photon_grid(params.radius, static_cast<float>(setup.extent), setup.buckets);
    for (int c = 0; c < 3; ++c) {
        const double most = setup.most_power[c];
        params.power_scale[c] = most > 0.0 ? static_cast<float>(gpu::kPhotonQuanta / most) : 0.0f;
        params.power_unit[c] = static_cast<float>(most / gpu::kPhotonQuanta);
    }
    params.capacity = setup.capacity;
    params.photon_count = setup.photon_count;
    params.iteration = setup.iteration;
    return params;
}

void record_photon_clear(const RenderPlan& plan, const gpu::PhotonParams& params, Recording& recording) {
    recording.upload(use_buffer(plan, "photon.frame", recording), to_bytes(params));
    recording.clear(use_buffer(plan, "photon.head", recording));
    recording.clear(use_buffer(plan, "photon.counts", recording));
}

void record_photon_sort(const RenderPlan& plan, const gpu::PhotonParams& params, Recording& recording) {
    record_photon_scan(plan, params, recording);
    const std::string head = use_buffer(plan, "photon.head", recording);
    recording.dispatch_indirect(
        {.label = "photon.sort",
         .shader = "photon_sort",
         .bindings = {{"PhotonFrame", use_buffer(plan, "photon.frame", recording)},
                      {"PhotonHeads", head},
                      {"StoredPhotons", use_buffer(plan, "photon.stored", recording)},
                      {"BucketStarts", use_buffer(plan, "photon.starts", recording)},
                      {"SortedPlaces", use_buffer(plan, "photon.places", recording)},
                      {"SortedPowers", use_buffer(plan, "photon.powers", recording)}}},
        head);
}

PhotonPlanes record_photon_gather(const RenderPlan& plan, const Slice& slice, const Plane& hits,
                                  Recording& recording) {
    const PhotonPlanes planes{{use_buffer(plan, "photon.light", recording)},
                              {use_buffer(plan, "photon.narrow", recording)}};
    recording.dispatch({.label = "photon.gather",
                        .shader = "photon_gather",
                        .extent = pixel_extent(plan, slice),
                        .bindings = {{"Frame", use_buffer(plan, "frame", recording)},
                                     {"PhotonFrame", use_buffer(plan, "photon.frame", recording)},
                                     {"Hits", hits.buffer},
                                     {"BucketStarts", use_buffer(plan, "photon.starts", recording)},
                                     {"SortedPlaces", use_buffer(plan, "photon.places", recording)},
                                     {"SortedPowers", use_buffer(plan, "photon.powers", recording)},
                                     {"Light", planes.light.buffer},
                                     {"NarrowLight", planes.narrow.buffer}}});
    return planes;
}

}  // namespace voxilux
