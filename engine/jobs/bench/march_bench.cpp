#include "jobs/bench/march_bench.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "base/checked_cast.h"
#include "base/error.h"
#include "shared/projection.h"

namespace voxilux {
namespace {

constexpr std::uint64_t kJudgedCells = 20'000'000;  // about a second of cell-by-cell walking per kind of rays

BufferProxy rays_buffer(RayKind kind, std::uint32_t count) {
    return {fmt::format("bench.rays.{}", name_of(kind)), std::max(count, 1u) * sizeof(gpu::Ray), true};
}

BufferProxy hits_buffer(RayKind kind, std::uint32_t count) {
    return {fmt::format("bench.hits.{}", name_of(kind)), count * sizeof(gpu::BenchHit), true};
}

}  // namespace

MarchBench::MarchBench(const BenchScene& scene, const MarchBenchOptions& options, Device& device)
    : scene_(scene),
      has_beams_(options.has_beams),
      frame_(bench_frame(scene, options.size, options.seed)),
      executor_(device, pass_shaders(), {.time_dispatches = false}) {
    {
        const MarchWorld guide = build_march_world(scene.world);
        for (const RayKind kind : options.kinds)
            rays_.push_back(place_rays(kind, bench_rays(scene, guide, kind, options.size, options.seed),
                                       device.limits()));
    }
    for (const Traversal traversal : options.traversals)
        structures_.push_back(
            place_structure(scene.world, traversal, options.builder, device.limits(), executor_));
}

MarchBench::RayList MarchBench::place_rays(RayKind kind, const std::vector<gpu::Ray>& rays,
                                           const DeviceLimits& limits) {
    const auto count = checked_cast<std::uint32_t>(rays.size(), "rays");
    const BufferProxy buffer = rays_buffer(kind, count);
    const std::uint64_t most =
        std::min<std::uint64_t>(limits.max_binding_bytes, limits.max_texels * sizeof(std::uint32_t));
    if (buffer.size_bytes > most) {
        throw Error(ExitCode::out_of_memory,
                    fmt::format("{} {} rays take {} MiB, the device binds {} MiB; choose a smaller --size",
                                count, name_of(kind), buffer.size_bytes >> 20, most >> 20));
    }
    Recording recording;
    recording.declare(buffer);
    if (count > 0) recording.upload(buffer.name, std::as_bytes(std::span(rays)));
    executor_.run(recording);
    return {.kind = kind, .count = count, .verdicts = check_rays(scene_.world, rays, kJudgedCells)};
}

std::vector<MarchContestant> MarchBench::contestants() {
    std::vector<MarchContestant> all;
    for (const PlacedStructure& structure : structures_) {
        for (const RayList& rays : rays_)
            all.push_back(contestant({structure, rays, false}));
        for (const RayList& rays : rays_)
            if (can_start_at_beams(structure, rays)) all.push_back(contestant({structure, rays, true}));
    }
    return all;
}

// Beams run through boxes, and each is that of a whole tile of camera rays.
bool MarchBench::can_start_at_beams(const PlacedStructure& structure, const RayList& rays) const {
    return has_beams_ && has_free_boxes(structure.traversal) && rays.kind == RayKind::primary &&
           frame_.width % gpu::kBeamPixels == 0 && frame_.height % gpu::kBeamPixels == 0;
}

MarchContestant MarchBench::contestant(const March& march) {
    MarchContestant made{.row = row_of(march)};
    if (!march.structure.reason.empty() || march.rays.count == 0) return made;
    judge(made.row, march);
    made.run = [this, march](std::uint32_t repeats) { return run(march, repeats); };
    return made;
}

BenchRow MarchBench::row_of(const March& march) const {
    const PlacedStructure& structure = march.structure;
    BenchRow row{
        .scene = scene_.name,
        .extent = scene_.extent,
        .traversal = fmt::format("{}{}", name_of(structure.traversal), march.has_beams ? ".beams" : ""),
        .rays = std::string(name_of(march.rays.kind)),
        .reason = structure.reason,
        .count = march.rays.count,
        .memory_bytes = structure.bytes.total(),
        .build_s = structure.cpu_build,
        .checked = march.rays.verdicts.rays.size()};
    if (structure.device_build) row.device_build_s = structure.device_build->wall;
    return row;
}

void MarchBench::judge(BenchRow& row, const March& march) {
    const std::string buffer = hits_buffer(march.rays.kind, march.rays.count).name;
    Recording recording = record(march, 1);
    recording.readback(buffer);
    const RunResult result = executor_.run(recording);
    std::vector<gpu::BenchHit> hits(march.rays.count);
    std::memcpy(hits.data(), result.readbacks.at(buffer).data(), hits.size() * sizeof(gpu::BenchHit));
    row.mismatches = count_mismatches(march.rays.verdicts, hits);
    std::uint64_t steps = 0;
    for (const gpu::BenchHit& hit : hits)
        steps += hit.steps;
    row.steps = static_cast<double>(steps) / march.rays.count;
}

Seconds MarchBench::run(const March& march, std::uint32_t repeats) {
    const Recording recording = record(march, repeats);
    const Stopwatch watch;
    executor_.run(recording);
    return watch.elapsed();
}

Recording MarchBench::record(const March& march, std::uint32_t repeats) const {
    Recording recording;
    const BufferProxy inputs = rays_buffer(march.rays.kind, march.rays.count);
    const BufferProxy outputs = hits_buffer(march.rays.kind, march.rays.count);
    const gpu::uvec2 beams(gpu::beam_count(frame_.width), gpu::beam_count(frame_.height));
    const BufferProxy starts{"bench.starts", std::uint64_t{beams.x} * beams.y * sizeof(float)};
    for (const BufferProxy& buffer : {inputs, outputs, starts})
        recording.declare(buffer);
    Dispatch dispatch{
        .label = "bench.march",
        .shader = "bench_march",
        .extent = {march.rays.count, 1, 1},
        .bindings = {{"Rays", inputs.name}, {"BenchHits", outputs.name}, {"Starts", starts.name}},
        .constants = {{"has_beams", march.has_beams ? 1u : 0u},
                      {"have_entries", march.rays.kind == RayKind::primary ? 1u : 0u}},
        .push = to_bytes(gpu::BenchMarchPush{
            .count = march.rays.count, .chunks = march.structure.chunks, .beams = beams})};
    point_to_structure(march.structure, recording, dispatch);
    std::vector<Dispatch> once{dispatch};
    if (march.has_beams) once.insert(once.begin(), beam_dispatch(march.structure, starts.name, recording));
    for (std::uint32_t i = 0; i < repeats; ++i)
        for (const Dispatch& part : once)
            recording.dispatch(part);
    return recording;
}

// Finds where the rays of each tile start.
Dispatch MarchBench::beam_dispatch(const PlacedStructure& structure, const std::string& starts,
                                   Recording& recording) const {
    const BufferProxy frame{"bench.frame", sizeof(gpu::FrameParams)};
    recording.declare(frame);
    recording.upload(frame.name, to_bytes(frame_));
    Dispatch dispatch{.label = "bench.beam",
                      .shader = "primary_beam",
                      .extent = {gpu::beam_count(frame_.width) * gpu::beam_count(frame_.height), 1, 1},
                      .bindings = {{"Frame", frame.name}, {"Starts", starts}},
                      .constants = {{"projection", static_cast<std::uint32_t>(gpu::kPerspective)}}};
    point_to_structure(structure, recording, dispatch);
    return dispatch;
}

std::vector<BenchRow> bench_march(const BenchScene& scene, const MarchBenchOptions& options, Device& device) {
    MarchBench bench(scene, options, device);
    std::vector<MarchContestant> contestants = bench.contestants();
    run_contest(contestants, options.rounds);
    return rows_of(contestants);
}

}  // namespace voxilux
