#include "passes/photon.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "shared/photon_cell.h"
#include "shared/photon_power.h"

namespace voxilux {
namespace {

constexpr double kLargestFloat = 3.4e38;

// One of the three dispatches of the prefix sum, over `count` runs.
void record_scan_level(const RenderPlan& plan, std::uint32_t level, std::uint32_t count,
                       Recording& recording) {
    recording.dispatch({.label = "photon.scan",
                        .shader = "photon_scan",
                        .extent = {count, 1, 1},
                        .bindings = {{"PhotonFrame", use_buffer(plan, "photon.frame", recording)},
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

// Of every pass over visible points.
std::vector<Binding> point_bindings(const RenderPlan& plan, const Plane& hits, Recording& recording) {
    return {{"Frame", use_buffer(plan, "frame", recording)},
            {"PhotonFrame", use_buffer(plan, "photon.frame", recording)},
            {"Hits", hits.buffer}};
}

PhotonPlanes photon_planes(const RenderPlan& plan, Recording& recording) {
    return {{use_buffer(plan, "photon.light", recording)}, {use_buffer(plan, "photon.narrow", recording)}};
}

// Adds what a pass needs that turns sums into light.
void let_resolve(const RenderPlan& plan, const PhotonPlanes& planes, Dispatch& dispatch,
                 Recording& recording) {
    dispatch.bindings.insert(dispatch.bindings.end(), {{"Spheres", spheres_buffer(plan, recording)},
                                                       {"SphereTable", sphere_table_buffer(plan, recording)},
                                                       {"Light", planes.light.buffer},
                                                       {"NarrowLight", planes.narrow.buffer}});
    for (const Constant& constant : sphere_constants(plan))
        dispatch.constants.push_back(constant);
}

// Sorts the visible points into buckets.
void record_points(const RenderPlan& plan, const gpu::PhotonParams& params, const Slice& slice,
                   const Plane& hits, Recording& recording) {
    const std::string ranks = use_buffer(plan, "photon.ranks", recording);
    Dispatch point{.label = "photon.point",
                   .shader = "photon_point",
                   .extent = pixel_extent(plan, slice),
                   .bindings = point_bindings(plan, hits, recording)};
    point.bindings.insert(
        point.bindings.end(),
        {{"BucketCounts", use_buffer(plan, "photon.counts", recording)}, {"PointRanks", ranks}});
    recording.dispatch(std::move(point));
    record_photon_scan(plan, params, recording);
    Dispatch place{.label = "photon.place",
                   .shader = "photon_place",
                   .extent = pixel_extent(plan, slice),
                   .bindings = point_bindings(plan, hits, recording)};
    place.bindings.insert(place.bindings.end(),
                          {{"PointRanks", ranks},
                           {"BucketStarts", use_buffer(plan, "photon.starts", recording)},
                           {"SortedPoints", use_buffer(plan, "photon.points", recording)}});
    recording.dispatch(std::move(place));
}

// Invocations of a pass over the pixels of a slice in tiles of 8x8.
Extent tile_extent(const RenderPlan& plan, const Slice& slice) {
    const auto columns = static_cast<std::uint32_t>(plan.settings.size.x);
    return {(columns + 7) / 8 * ((slice.row_count + 7) / 8) * 64, 1, 1};
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
        const double scale = gpu::kPhotonQuanta / most;
        // Light whose quanta a float cannot count is none.
        params.power_scale[c] = scale < kLargestFloat ? static_cast<float>(scale) : 0.0f;
        params.power_unit[c] = static_cast<float>(most / gpu::kPhotonQuanta);
    }
    params.capacity = setup.capacity;
    params.iteration = setup.iteration;
    params.alpha = static_cast<float>(setup.alpha);
    return params;
}

void record_photon_clear(const RenderPlan& plan, const gpu::PhotonParams& params, Recording& recording) {
    recording.upload(use_buffer(plan, "photon.frame", recording), to_bytes(params));
    recording.clear(use_buffer(plan, "photon.head", recording));
    recording.clear(use_buffer(plan, "photon.counts", recording));
}

void record_photon_mark(const RenderPlan& plan, const Slice& slice, const Plane& hits, Recording& recording) {
    const std::string wanted = use_buffer(plan, "photon.wanted", recording);
    recording.clear(wanted);
    Dispatch dispatch{.label = "photon.mark",
                      .shader = "photon_mark",
                      .extent = pixel_extent(plan, slice),
                      .bindings = point_bindings(plan, hits, recording)};
    dispatch.bindings.push_back({"WantedCells", wanted});
    recording.dispatch(std::move(dispatch));
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
                      {"SortedPhotons", use_buffer(plan, "photon.sorted", recording)}}},
        head);
}

PhotonPlanes record_photon_gather(const RenderPlan& plan, const Slice& slice, const Plane& hits,
                                  PhotonRadii radii, Recording& recording) {
    const bool own = radii == PhotonRadii::own;
    const PhotonPlanes planes = photon_planes(plan, recording);
    Dispatch dispatch{.label = "photon.gather",
                      .shader = "photon_gather",
                      .extent = tile_extent(plan, slice),
                      .bindings = point_bindings(plan, hits, recording)};
    dispatch.bindings.insert(dispatch.bindings.end(),
                             {{"Tally", use_buffer(plan, "tally", recording)},
                              {"BucketStarts", use_buffer(plan, "photon.starts", recording)},
                              {"SortedPhotons", use_buffer(plan, "photon.sorted", recording)}});
    dispatch.bindings.push_back(
        {"PixelRadii", own ? use_buffer(plan, "photon.radii", recording) : placeholder_buffer(recording)});
    dispatch.constants.push_back({"own_radii", own ? 1u : 0u});
    dispatch.constants.push_back({"known_lanes", plan.photons.gather_lanes});
    let_resolve(plan, planes, dispatch, recording);
    recording.dispatch(std::move(dispatch));
    return planes;
}

PhotonPlanes record_photon_splat(const RenderPlan& plan, const gpu::PhotonParams& params, const Slice& slice,
                                 const Plane& hits, Recording& recording) {
    record_points(plan, params, slice, hits, recording);
    const std::string totals = use_buffer(plan, "photon.totals", recording);
    const std::string head = use_buffer(plan, "photon.head", recording);
    recording.clear(totals);
    recording.dispatch_indirect({.label = "photon.splat",
                                 .shader = "photon_splat",
                                 .bindings = {{"PhotonFrame", use_buffer(plan, "photon.frame", recording)},
                                              {"Tally", use_buffer(plan, "tally", recording)},
                                              {"PhotonHeads", head},
                                              {"StoredPhotons", use_buffer(plan, "photon.stored", recording)},
                                              {"BucketStarts", use_buffer(plan, "photon.starts", recording)},
                                              {"SortedPoints", use_buffer(plan, "photon.points", recording)},
                                              {"PhotonTotals", totals}}},
                                head);
    const PhotonPlanes planes = photon_planes(plan, recording);
    Dispatch resolve{.label = "photon.resolve",
                     .shader = "photon_resolve",
                     .extent = pixel_extent(plan, slice),
                     .bindings = point_bindings(plan, hits, recording)};
    resolve.bindings.push_back({"PhotonTotals", totals});
    let_resolve(plan, planes, resolve, recording);
    recording.dispatch(std::move(resolve));
    return planes;
}

Plane record_photon_bias(const RenderPlan& plan, const Slice& slice, const SpecularPlanes& seen,
                         const PhotonPlanes& photons, Recording& recording) {
    const Plane bias{use_buffer(plan, "photon.bias", recording)};
    recording.dispatch(
        {.label = "photon.bias",
         .shader = "photon_bias",
         .extent = pixel_extent(plan, slice),
         .bindings = {{"Frame", use_buffer(plan, "frame", recording)},
                      {"Materials", materials_buffer(plan, recording)},
                      {"Hits", seen.hits.buffer},
                      {"Weights", seen.weights.buffer},
                      {"Light", photons.light.buffer},
                      {"NarrowLight", photons.narrow.buffer},
                      {"Bias", bias.buffer}},
         .constants = {{"hits_stride", seen.hits.stride}, {"weights_stride", seen.weights.stride}}});
    return bias;
}

}  // namespace voxilux
