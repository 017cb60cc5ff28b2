#include "jobs/bench/march_bench.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "base/checked_cast.h"
#include "base/error.h"

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
    : scene_(scene), executor_(device, pass_shaders(), {.time_dispatches = false}) {
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
    if (buffer.size_bytes > limits.max_binding_bytes) {
        throw Error(
            ExitCode::out_of_memory,
            fmt::format("{} {} rays take {} MiB, the device binds {} MiB; choose a smaller --size", count,
                        name_of(kind), buffer.size_bytes >> 20, limits.max_binding_bytes >> 20));
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
        for (const RayList& rays : rays_) {
            MarchContestant contestant{.row = row_of(structure, rays)};
            if (structure.reason.empty() && rays.count > 0) {
                judge(contestant.row, structure, rays);
                contestant.run = [this, &structure, &rays](std::uint32_t repeats) {
                    return run(structure, rays, repeats);
                };
            }
            all.push_back(std::move(contestant));
        }
    }
    return all;
}

BenchRow MarchBench::row_of(const PlacedStructure& structure, const RayList& rays) const {
    BenchRow row{.scene = scene_.name,
                 .extent = scene_.extent,
                 .traversal = std::string(name_of(structure.traversal)),
                 .rays = std::string(name_of(rays.kind)),
                 .reason = structure.reason,
                 .count = rays.count,
                 .memory_bytes = structure.bytes.total(),
                 .build_s = structure.cpu_build,
                 .checked = rays.verdicts.rays.size()};
    if (structure.device_build) row.device_build_s = structure.device_build->wall;
    return row;
}

void MarchBench::judge(BenchRow& row, const PlacedStructure& structure, const RayList& rays) {
    const std::string buffer = hits_buffer(rays.kind, rays.count).name;
    Recording recording = record_march(structure, rays, 1);
    recording.readback(buffer);
    const RunResult result = executor_.run(recording);
    std::vector<gpu::BenchHit> hits(rays.count);
    std::memcpy(hits.data(), result.readbacks.at(buffer).data(), hits.size() * sizeof(gpu::BenchHit));
    row.mismatches = count_mismatches(rays.verdicts, hits);
    std::uint64_t steps = 0;
    for (const gpu::BenchHit& hit : hits)
        steps += hit.steps;
    row.steps = static_cast<double>(steps) / rays.count;
}

Seconds MarchBench::run(const PlacedStructure& structure, const RayList& rays, std::uint32_t repeats) {
    const Recording recording = record_march(structure, rays, repeats);
    const Stopwatch watch;
    executor_.run(recording);
    return watch.elapsed();
}

Recording MarchBench::record_march(const PlacedStructure& structure, const RayList& rays,
                                   std::uint32_t repeats) {
    Recording recording;
    const BufferProxy inputs = rays_buffer(rays.kind, rays.count);
    const BufferProxy outputs = hits_buffer(rays.kind, rays.count);
    recording.declare(inputs);
    recording.declare(outputs);
    Dispatch dispatch{.label = "bench.march",
                      .shader = "bench_march",
                      .extent = {rays.count, 1, 1},
                      .bindings = {{"Rays", inputs.name}, {"BenchHits", outputs.name}},
                      .push = to_bytes(gpu::BenchMarchPush{.count = rays.count, .chunks = structure.chunks})};
    point_to_structure(structure, recording, dispatch);
    for (std::uint32_t i = 0; i < repeats; ++i)
        recording.dispatch(dispatch);
    return recording;
}

std::vector<BenchRow> bench_march(const BenchScene& scene, const MarchBenchOptions& options, Device& device) {
    MarchBench bench(scene, options, device);
    std::vector<MarchContestant> contestants = bench.contestants();
    run_contest(contestants, options.rounds);
    return rows_of(contestants);
}

}  // namespace voxilux
