#include "passes/photons/photon.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "passes/photons/photon_buffers.h"
#include "shared/photon_cell.h"
#include "shared/photon_power.h"

namespace voxilux {
namespace {

constexpr double kLargestFloat = 3.4e38;

// One of the three dispatches of the prefix sum, over `count` runs.
void record_scan_level(const RenderPlan& plan, std::uint32_t level, std::uint32_t count,
                       Recording& recording) {
    recording.dispatch(
        {.label = "photon.scan",
         .shader = "photon_scan",
         .extent = {count, 1, 1},
         .bindings = {{"PhotonFrame", photon_frame_buffer(recording)},
                      {"PhotonHeads", photon_head_buffer(recording)},
                      {"BucketCounts", photon_counts_buffer(plan, recording)},
                      {"BucketRunSums",
                       declare<gpu::uint>(recording, "photon.runs", gpu::scan_runs(plan.photons.buckets))},
                      {"BucketStarts", photon_starts_buffer(plan, recording)}},
         .constants = {{"level", level}}});
}

void record_photon_scan(const RenderPlan& plan, const gpu::PhotonParams& params, Recording& recording) {
    const std::uint32_t runs = gpu::scan_runs(params.grid.mask + 1);
    record_scan_level(plan, 0, runs, recording);
    record_scan_level(plan, 1, gpu::kLinearGroup, recording);
    record_scan_level(plan, 2, runs, recording);
}

// Bindings of every pass over visible points.
std::vector<Binding> point_bindings(const Plane& hits, Recording& recording) {
    return {{"Frame", frame_buffer(recording)},
            {"PhotonFrame", photon_frame_buffer(recording)},
            {"Hits", hits.buffer}};
}

PhotonPlanes photon_planes(const RenderPlan& plan, Recording& recording) {
    return {{declare_plane<gpu::vec3>(plan, "photon.light", recording)},
            {declare_plane<gpu::vec3>(plan, "photon.half_area", recording)}};
}

std::string totals_buffer(const RenderPlan& plan, Recording& recording) {
    return declare<std::uint64_t>(recording, "photon.totals", 6 * plan.tile_pixels());
}

std::string met_buffer(const RenderPlan& plan, PhotonRadii radii, Recording& recording) {
    if (radii == PhotonRadii::common) return placeholder_buffer(recording);
    return declare<gpu::uint>(recording, "photon.met", plan.tile_pixels());
}

// Adds the bindings and constants of a pass that turns sums into light.
void let_resolve(const RenderPlan& plan, const PhotonPlanes& planes, PhotonRadii radii, Dispatch& dispatch,
                 Recording& recording) {
    const bool own = radii == PhotonRadii::own;
    dispatch.bindings.push_back(
        {"PixelRadii",
         own ? declare_plane<gpu::PixelRadius>(plan, "photon.radii", recording, Lifetime::persistent)
             : placeholder_buffer(recording)});
    dispatch.constants.push_back({"own_radii", own ? 1u : 0u});
    dispatch.bindings.insert(dispatch.bindings.end(), {{"Counters", counters_buffer(recording)},
                                                       {"Spheres", spheres_buffer(plan, recording)},
                                                       {"SphereTree", sphere_tree_buffer(plan, recording)},
                                                       {"SphereTable", sphere_table_buffer(plan, recording)},
                                                       {"Light", planes.light.buffer},
                                                       {"HalfAreaLight", planes.half_area.buffer}});
    for (const Constant& constant : sphere_constants(plan))
        dispatch.constants.push_back(constant);
}

// Invocations of a pass over the pixels of a tile in tiles of 8x8.
Extent tile_extent(const RenderPlan& plan, const DispatchTile& tile) {
    const auto columns = static_cast<std::uint32_t>(plan.settings.size.x);
    return {(columns + 7) / 8 * ((tile.row_count + 7) / 8) * 64, 1, 1};
}

Dispatch gathering(const RenderPlan& plan, const DispatchTile& tile, const Plane& hits,
                   Recording& recording) {
    Dispatch dispatch{.label = "photon.gather",
                      .shader = "photon_gather",
                      .extent = tile_extent(plan, tile),
                      .bindings = point_bindings(hits, recording),
                      .constants = {{"known_lanes", plan.photons.gather_lanes}}};
    dispatch.bindings.insert(dispatch.bindings.end(),
                             {{"BucketStarts", photon_starts_buffer(plan, recording)},
                              {"SortedPhotons", photon_sorted_buffer(plan, recording)}});
    return dispatch;
}

}  // namespace

gpu::PhotonParams photon_params(const PhotonSetup& setup) {
    VX_ASSERT(std::has_single_bit(setup.buckets));
    const double radius = std::max(setup.radius, static_cast<double>(gpu::kMinPhotonRadius));
    gpu::PhotonParams params{};
    params.radius = static_cast<float>(radius);
    params.half_area_radius = static_cast<float>(radius / std::numbers::sqrt2);
    params.grid = gpu::photon_grid(params.radius, static_cast<float>(setup.extent), setup.buckets);
    for (int c = 0; c < 3; ++c) {
        const double most = setup.max_power[c];
        const double scale = gpu::kPhotonQuanta / most;
        // A channel with so little power that its scale overflows a float counts as having none.
        params.power_scale[c] = scale < kLargestFloat ? static_cast<float>(scale) : 0.0f;
        params.power_unit[c] = static_cast<float>(most / gpu::kPhotonQuanta);
    }
    params.capacity = setup.capacity;
    params.iteration = setup.iteration;
    params.alpha = static_cast<float>(setup.alpha);
    return params;
}

void record_photon_clear(const RenderPlan& plan, const gpu::PhotonParams& params, Recording& recording) {
    recording.upload(photon_frame_buffer(recording), to_bytes(params));
    recording.clear(photon_head_buffer(recording));
    recording.clear(photon_counts_buffer(plan, recording));
}

void record_photon_mark(const RenderPlan& plan, const DispatchTile& tile, const Plane& hits,
                        Recording& recording) {
    const std::string wanted = photon_wanted_buffer(plan, recording);
    recording.clear(wanted);
    Dispatch dispatch{.label = "photon.mark",
                      .shader = "photon_mark",
                      .extent = pixel_extent(plan, tile),
                      .bindings = point_bindings(hits, recording)};
    dispatch.bindings.push_back({"WantedCells", wanted});
    recording.dispatch(std::move(dispatch));
}

void record_photon_sort(const RenderPlan& plan, const gpu::PhotonParams& params, Recording& recording) {
    record_photon_scan(plan, params, recording);
    const std::string head = photon_head_buffer(recording);
    recording.dispatch_indirect({.label = "photon.sort",
                                 .shader = "photon_sort",
                                 .bindings = {{"PhotonFrame", photon_frame_buffer(recording)},
                                              {"PhotonHeads", head},
                                              {"StoredPhotons", photon_store_buffer(plan, recording)},
                                              {"BucketStarts", photon_starts_buffer(plan, recording)},
                                              {"SortedPhotons", photon_sorted_buffer(plan, recording)}}},
                                head);
}

PhotonPlanes record_photon_gather(const RenderPlan& plan, const DispatchTile& tile, const Plane& hits,
                                  PhotonRadii radii, Recording& recording) {
    const PhotonPlanes planes = photon_planes(plan, recording);
    const std::string unused = placeholder_buffer(recording);
    Dispatch dispatch = gathering(plan, tile, hits, recording);
    dispatch.bindings.insert(dispatch.bindings.end(), {{"PhotonTotals", unused}, {"MetTotals", unused}});
    let_resolve(plan, planes, radii, dispatch, recording);
    recording.dispatch(std::move(dispatch));
    return planes;
}

void record_photon_add(const RenderPlan& plan, const DispatchTile& tile, const Plane& hits, PhotonRadii radii,
                       Recording& recording) {
    const PhotonPlanes none{{placeholder_buffer(recording)}, {placeholder_buffer(recording)}};
    Dispatch dispatch = gathering(plan, tile, hits, recording);
    dispatch.bindings.insert(dispatch.bindings.end(), {{"PhotonTotals", totals_buffer(plan, recording)},
                                                       {"MetTotals", met_buffer(plan, radii, recording)}});
    dispatch.constants.push_back({"adds_up", 1u});
    let_resolve(plan, none, radii, dispatch, recording);
    recording.dispatch(std::move(dispatch));
}

void record_photon_points(const RenderPlan& plan, const gpu::PhotonParams& params, const DispatchTile& tile,
                          const Plane& hits, Recording& recording) {
    const std::string ranks = declare_plane<gpu::uint>(plan, "photon.ranks", recording);
    Dispatch point{.label = "photon.point",
                   .shader = "photon_point",
                   .extent = pixel_extent(plan, tile),
                   .bindings = point_bindings(hits, recording)};
    point.bindings.insert(point.bindings.end(),
                          {{"BucketCounts", photon_counts_buffer(plan, recording)}, {"PointRanks", ranks}});
    recording.dispatch(std::move(point));
    record_photon_scan(plan, params, recording);
    Dispatch place{.label = "photon.place",
                   .shader = "photon_place",
                   .extent = pixel_extent(plan, tile),
                   .bindings = point_bindings(hits, recording)};
    place.bindings.insert(
        place.bindings.end(),
        {{"PointRanks", ranks},
         {"BucketStarts", photon_starts_buffer(plan, recording)},
         {"SortedPoints", declare_plane<gpu::PhotonPoint>(plan, "photon.points", recording)}});
    recording.dispatch(std::move(place));
}

void record_photon_splat(const RenderPlan& plan, Recording& recording) {
    const std::string head = photon_head_buffer(recording);
    recording.dispatch_indirect(
        {.label = "photon.splat",
         .shader = "photon_splat",
         .bindings = {{"PhotonFrame", photon_frame_buffer(recording)},
                      {"Counters", counters_buffer(recording)},
                      {"PhotonHeads", head},
                      {"StoredPhotons", photon_store_buffer(plan, recording)},
                      {"BucketStarts", photon_starts_buffer(plan, recording)},
                      {"SortedPoints", declare_plane<gpu::PhotonPoint>(plan, "photon.points", recording)},
                      {"PhotonTotals", totals_buffer(plan, recording)}}},
        head);
}

void record_photon_totals(const RenderPlan& plan, PhotonRadii radii, Recording& recording) {
    recording.clear(totals_buffer(plan, recording));
    if (radii == PhotonRadii::own) recording.clear(met_buffer(plan, radii, recording));
}

PhotonPlanes record_photon_resolve(const RenderPlan& plan, const DispatchTile& tile, const Plane& hits,
                                   PhotonRadii radii, Recording& recording) {
    const PhotonPlanes planes = photon_planes(plan, recording);
    Dispatch resolve{.label = "photon.resolve",
                     .shader = "photon_resolve",
                     .extent = pixel_extent(plan, tile),
                     .bindings = point_bindings(hits, recording)};
    resolve.bindings.insert(resolve.bindings.end(), {{"PhotonTotals", totals_buffer(plan, recording)},
                                                     {"MetTotals", met_buffer(plan, radii, recording)}});
    let_resolve(plan, planes, radii, resolve, recording);
    recording.dispatch(std::move(resolve));
    return planes;
}

}  // namespace voxilux
