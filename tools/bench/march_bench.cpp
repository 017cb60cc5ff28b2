#include "bench/march_bench.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "base/checked_cast.h"
#include "base/error.h"
#include "bench/ray_judge.h"

namespace voxilux {
namespace {

constexpr std::uint64_t kJudgedCells = 20'000'000;  // about a second of plain walking per kind of rays
constexpr double kLeastRunCpuS = 0.1;               // a measured run repeats its dispatch until it takes this
constexpr double kMostRepeats = 256;

// The rays of a kind, on the device, with what some of them must meet.
struct RayList {
    RayKind kind;
    std::uint32_t count = 0;
    Verdicts verdicts;
};

// A row while it is measured.
struct Measured {
    BenchRow row;
    const PlacedStructure* structure = nullptr;
    const RayList* rays = nullptr;
    std::uint32_t repeats = 1;
    Seconds best{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};

    [[nodiscard]] bool can_run() const { return row.reason.empty() && rays->count > 0; }
};

BufferProxy rays_buffer(RayKind kind, std::uint32_t count) {
    return {fmt::format("bench.rays.{}", name_of(kind)), std::max(count, 1u) * sizeof(gpu::Ray), true};
}

BufferProxy hits_buffer(RayKind kind, std::uint32_t count) {
    return {fmt::format("bench.hits.{}", name_of(kind)), count * sizeof(gpu::BenchHit), true};
}

RayList place_rays(const VoxelWorld& world, RayKind kind, const std::vector<gpu::Ray>& rays,
                   const DeviceLimits& limits, Executor& executor) {
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
    executor.run(recording);
    return {.kind = kind, .count = count, .verdicts = judge_rays(world, rays, kJudgedCells)};
}

Recording record_march(const Measured& one, std::uint32_t repeats) {
    const RayList& rays = *one.rays;
    Recording recording;
    const BufferProxy inputs = rays_buffer(rays.kind, rays.count);
    const BufferProxy outputs = hits_buffer(rays.kind, rays.count);
    recording.declare(inputs);
    recording.declare(outputs);
    Dispatch dispatch{
        .label = "bench.march",
        .shader = "bench_march",
        .extent = {rays.count, 1, 1},
        .bindings = bind_structure(*one.structure, recording),
        .constants = {{"traversal", static_cast<std::uint32_t>(one.structure->traversal)}},
        .push = to_bytes(gpu::BenchMarchPush{.count = rays.count, .chunks = one.structure->chunks})};
    dispatch.bindings.push_back({"Rays", inputs.name});
    dispatch.bindings.push_back({"BenchHits", outputs.name});
    for (std::uint32_t i = 0; i < repeats; ++i)
        recording.dispatch(dispatch);
    return recording;
}

Seconds run_march(const Measured& one, Executor& executor) {
    const Recording recording = record_march(one, one.repeats);
    const Stopwatch watch;
    executor.run(recording);
    return watch.elapsed();
}

// Compiles the shader, judges its hits and finds out how often to repeat it.
void prepare(Measured& one, Executor& executor) {
    const RayList& rays = *one.rays;
    const std::string buffer = hits_buffer(rays.kind, rays.count).name;
    Recording recording = record_march(one, 1);
    recording.readback(buffer);
    const RunResult result = executor.run(recording);
    std::vector<gpu::BenchHit> hits(rays.count);
    std::memcpy(hits.data(), result.readbacks.at(buffer).data(), hits.size() * sizeof(gpu::BenchHit));
    one.row.mismatches = count_mismatches(rays.verdicts, hits);
    std::uint64_t steps = 0;
    for (const gpu::BenchHit& hit : hits)
        steps += hit.steps;
    one.row.steps = static_cast<double>(steps) / rays.count;
    const double once = run_march(one, executor).cpu;
    one.repeats = static_cast<std::uint32_t>(
        std::clamp(std::ceil(kLeastRunCpuS / std::max(once, 1e-9)), 1.0, kMostRepeats));
}

void measure(Measured& one, Executor& executor) {
    const Seconds taken = run_march(one, executor);
    one.best.cpu = std::min(one.best.cpu, taken.cpu / one.repeats);
    one.best.wall = std::min(one.best.wall, taken.wall / one.repeats);
    const double million = static_cast<double>(one.rays->count) * 1e-6;
    one.row.mrays_per_cpu_s = million / one.best.cpu;
    one.row.mrays_per_s = million / one.best.wall;
}

BenchRow row_of(const BenchScene& scene, const PlacedStructure& structure, const RayList& rays) {
    return {
        .scene = scene.name,
        .extent = scene.extent,
        .traversal = std::string(name_of(structure.traversal)),
        .rays = std::string(name_of(rays.kind)),
        .reason = structure.reason,
        .count = rays.count,
        .memory_bytes = structure.bytes.total(),
        .build_s = structure.cpu_build,
        .device_build_s = structure.device_build ? std::optional(structure.device_build->wall) : std::nullopt,
        .checked = rays.verdicts.rays.size()};
}

}  // namespace

std::vector<BenchRow> bench_march(const BenchScene& scene, const MarchBenchOptions& options,
                                  const BenchRequest& request, Device& device) {
    Executor executor(device, pass_shaders(), {.time_dispatches = false});
    std::vector<RayList> rays;
    {
        const MarchWorld guide = build_march_world(scene.world);
        for (const RayKind kind : request.kinds)
            rays.push_back(place_rays(scene.world, kind,
                                      bench_rays(scene, guide, kind, request.size, request.seed),
                                      device.limits(), executor));
    }
    std::vector<PlacedStructure> structures;
    for (const Traversal traversal : options.traversals)
        structures.push_back(
            place_structure(scene.world, traversal, options.builder, device.limits(), executor));
    std::vector<Measured> all;
    for (const PlacedStructure& structure : structures)
        for (const RayList& list : rays)
            all.push_back({.row = row_of(scene, structure, list), .structure = &structure, .rays = &list});
    for (Measured& one : all)
        if (one.can_run()) prepare(one, executor);
    for (int round = 0; round < request.rounds; ++round)
        for (Measured& one : all)
            if (one.can_run()) measure(one, executor);
    std::vector<BenchRow> rows;
    std::ranges::transform(all, std::back_inserter(rows), &Measured::row);
    return rows;
}

}  // namespace voxilux
