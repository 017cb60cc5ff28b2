#include "support/photon_fixture.h"

#include <algorithm>

#include "passes/photons/photon_buffers.h"
#include "plan/plan_photons.h"
#include "world/sphere_tree.h"

namespace voxilux::test {
namespace {

// Does the work of the pass that traces photons.
void record_append(const RenderPlan& plan, const PhotonJob& job, bool sorts, Recording& recording) {
    const auto count = static_cast<std::uint32_t>(job.photons.size());
    recording.declare(
        {.name = "t.photons", .size_bytes = std::max<std::size_t>(count, 1) * sizeof(gpu::PhotonIn)});
    if (count == 0) return;
    recording.upload("t.photons", std::as_bytes(std::span(job.photons)));
    recording.dispatch(
        {.label = "t.append",
         .shader = "photon_append",
         .extent = {count, 1, 1},
         .bindings = {{"In", "t.photons"},
                      {"PhotonFrame", photon_frame_buffer(recording)},
                      {"Counters", counters_buffer(recording)},
                      {"PhotonHeads", photon_head_buffer(recording)},
                      {"StoredPhotons", photon_store_buffer(plan, recording)},
                      {"WantedCells", photon_wanted_buffer(plan, recording)},
                      {"BucketCounts", photon_counts_buffer(plan, recording)}},
         .constants = {{"sorts_photons", sorts ? 1u : 0u}, {"slots_at_once", job.slots_at_once}},
         .push = to_bytes(count)});
}

void record_inputs(const RenderPlan& plan, const PhotonJob& job, Recording& recording) {
    gpu::FrameParams frame{};
    frame.width = job.width;
    frame.height = rows_of(job);
    frame.row_count = frame.height;
    frame.column_count = job.width;
    recording.upload(frame_buffer(recording), to_bytes(frame));
    recording.clear(counters_buffer(recording));
    if (!job.spheres.empty())
        recording.upload(spheres_buffer(plan, recording), std::as_bytes(std::span(job.spheres)));
    if (plan.has_sphere_tree()) {
        const std::vector<gpu::SphereNode> tree = build_sphere_tree(job.spheres);
        recording.upload(sphere_tree_buffer(plan, recording), std::as_bytes(std::span(tree)));
    }
    recording.declare(
        {.name = "t.points", .size_bytes = std::size_t{job.width} * frame.height * sizeof(gpu::Hit)});
    recording.clear("t.points", 0xFFFFFFFFu);
    recording.upload("t.points", std::as_bytes(std::span(job.points)));
}

PhotonOutcome outcome_of(const RunResult& result, const PhotonPlanes& planes) {
    PhotonOutcome outcome;
    outcome.light = values_of<glm::vec3>(result, planes.light.buffer);
    outcome.half_area = values_of<glm::vec3>(result, planes.half_area.buffer);
    outcome.head = values_of<gpu::PhotonHead>(result, "photon.head").front();
    if (result.readbacks.contains("photon.sorted"))
        outcome.sorted = values_of<gpu::SortedPhoton>(result, "photon.sorted");
    if (result.readbacks.contains("photon.radii"))
        outcome.radii = values_of<gpu::PixelRadius>(result, "photon.radii");
    const auto counters = values_of<gpu::uint>(result, "counters");
    std::copy_n(counters.begin(), outcome.counters.size(), outcome.counters.begin());
    outcome.times = result.passes;
    return outcome;
}

PhotonPlanes record_scatter(const RenderPlan& plan, const gpu::PhotonParams& params, const DispatchTile& tile,
                            Recording& recording) {
    record_photon_points(plan, params, tile, {"t.points"}, recording);
    record_photon_totals(plan, PhotonRadii::common, recording);
    record_photon_splat(plan, recording);
    return record_photon_resolve(plan, tile, {"t.points"}, PhotonRadii::common, recording);
}

PhotonOutcome run_job(const PhotonJob& job, bool scatters, Executor& executor) {
    const RenderPlan plan = photon_plan(job);
    const gpu::PhotonParams params = photon_params(job.setup);
    const DispatchTile tile{.row_count = rows_of(job)};
    Recording recording;
    record_inputs(plan, job, recording);
    record_photon_clear(plan, params, recording);
    record_photon_mark(plan, tile, {"t.points"}, recording);
    record_append(plan, job, !scatters, recording);
    if (!scatters) record_photon_sort(plan, params, recording);
    const PhotonPlanes planes = scatters
                                    ? record_scatter(plan, params, tile, recording)
                                    : record_photon_gather(plan, tile, {"t.points"}, job.radii, recording);
    for (const std::string& buffer :
         {planes.light.buffer, planes.half_area.buffer, std::string("photon.head"), std::string("counters")})
        recording.readback(buffer);
    for (const char* buffer : {"photon.sorted", "photon.radii"})
        if (recording.find(buffer) != nullptr) recording.readback(buffer);
    return outcome_of(executor.run(recording), planes);
}

}  // namespace

std::uint32_t rows_of(const PhotonJob& job) {
    return static_cast<std::uint32_t>((job.points.size() + job.width - 1) / job.width);
}

RenderPlan photon_plan(const PhotonJob& job) {
    RenderPlan plan;
    plan.settings.size = {static_cast<int>(job.width), static_cast<int>(rows_of(job))};
    plan.tile_rows = rows_of(job);
    plan.effects[static_cast<std::size_t>(Effect::spheres)].on = !job.spheres.empty();
    if (job.knows_lanes) plan.photons.gather_lanes = gather_lanes(test_device().limits());
    plan.photons.capacity = std::max(job.setup.capacity, 1u);
    plan.photons.buckets = job.setup.buckets;
    plan.sphere_count = static_cast<std::uint32_t>(job.spheres.size());
    plan.world.sphere_nodes = build_sphere_tree(job.spheres).size();
    return plan;
}

PhotonOutcome run_photons(const PhotonJob& job, Executor& executor) {
    return run_job(job, false, executor);
}

PhotonOutcome run_splat(const PhotonJob& job, Executor& executor) {
    return run_job(job, true, executor);
}

}  // namespace voxilux::test
