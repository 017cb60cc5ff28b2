#include "bench/march_bench.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>

#include "base/checked_cast.h"
#include "base/error.h"
#include "bench/ray_judge.h"
#include "bench/stopwatch.h"
#include "shared/world_cell.h"
#include "vk/executor.h"
#include "world/structure_bytes.h"

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

// A structure on the device.
struct Placed {
    Traversal traversal;
    StructureBytes bytes;
    glm::ivec3 chunks{0};
    double build_s = 0.0;
    std::string reason;  // why it is not there
};

// A row while it is measured.
struct Measured {
    BenchRow row;
    const Placed* structure = nullptr;
    const RayList* rays = nullptr;
    std::uint32_t repeats = 1;
    Seconds best{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
};

std::string rays_buffer(RayKind kind) {
    return fmt::format("bench.rays.{}", name_of(kind));
}

std::string hits_buffer(RayKind kind) {
    return fmt::format("bench.hits.{}", name_of(kind));
}

std::string structure_buffer(Traversal traversal, const char* part) {
    return fmt::format("bench.{}.{}", name_of(traversal), part);
}

double mib(std::uint64_t bytes) {
    return static_cast<double>(bytes) / (1 << 20);
}

// Why the device cannot march the structure; empty when it can.
std::string misfit(const StructureBytes& bytes, const DeviceLimits& limits) {
    const auto over = [&](const char* part, std::uint64_t part_bytes) {
        if (part_bytes <= limits.max_binding_bytes) return std::string();
        return fmt::format("its {} take {:.0f} MiB, the device binds {:.0f} MiB", part, mib(part_bytes),
                           mib(limits.max_binding_bytes));
    };
    const std::string roots = over("roots", bytes.roots);
    if (!roots.empty()) return roots;
    const std::string nodes = over("nodes", bytes.nodes);
    return nodes.empty() ? over("leaves", bytes.leaves) : nodes;
}

template <class T>
void upload(const std::string& name, std::span<const T> values, Executor& executor) {
    Recording recording;
    // A binding needs at least one word, also where a level of a structure has no cells.
    recording.declare(
        {.name = name, .size_bytes = std::max<std::uint64_t>(values.size_bytes(), 4), .persistent = true});
    if (!values.empty()) recording.upload(name, std::as_bytes(values));
    executor.run(recording);
}

class MarchBench {
  public:
    MarchBench(const BenchScene& scene, const BenchRequest& request, Device& device)
        : scene_(scene),
          request_(request),
          limits_(device.limits()),
          executor_(device, pass_shaders(), {.time_dispatches = false}) {}

    std::vector<BenchRow> run(std::span<const Traversal> traversals) {
        place_all(traversals);
        std::vector<Measured> all = plan_rows();
        for (Measured& one : all)
            if (one.row.reason.empty()) prepare(one);
        for (int round = 0; round < request_.rounds; ++round)
            for (Measured& one : all)
                if (one.row.reason.empty() && one.row.count > 0) measure(one);
        std::vector<BenchRow> rows;
        for (const Measured& one : all)
            rows.push_back(finished_row(one));
        return rows;
    }

  private:
    // The structure that finds the rays is one of those that are measured, so it is built once.
    void place_all(std::span<const Traversal> traversals) {
        const Stopwatch watch;
        const MarchWorld guide = build_march_world(scene_.world);
        const double build_s = watch.elapsed().cpu;
        for (const RayKind kind : request_.kinds)
            place_rays(kind, guide);
        for (const Traversal traversal : traversals)
            structures_.push_back(traversal == guide.traversal ? place(guide, build_s)
                                                               : place_built(traversal));
    }

    void place_rays(RayKind kind, const MarchWorld& guide) {
        const std::vector<gpu::Ray> rays = bench_rays(scene_, guide, kind, request_.size, request_.seed);
        const std::span<const gpu::Ray> all(rays);
        if (all.size_bytes() > limits_.max_binding_bytes) {
            throw Error(ExitCode::out_of_memory,
                        fmt::format("the rays of {}x{} pixels take {:.0f} MiB, the device binds {:.0f} MiB; "
                                    "choose a smaller --size",
                                    request_.size.x, request_.size.y, mib(all.size_bytes()),
                                    mib(limits_.max_binding_bytes)));
        }
        upload(rays_buffer(kind), all, executor_);
        rays_.push_back({.kind = kind,
                         .count = checked_cast<std::uint32_t>(rays.size(), "rays"),
                         .verdicts = judge_rays(scene_.world, rays, kJudgedCells)});
    }

    // Bytes that the structure takes even if all its bricks are equal: bricks of 16 bits per voxel may be
    // stored once for all.
    [[nodiscard]] StructureBytes least_bytes(Traversal traversal) const {
        const auto id = static_cast<gpu::uint>(traversal);
        StructureBytes least = predict_bytes(take_census(scene_.world), traversal);
        if (gpu::root_log2(id) != 0 && !gpu::has_far_voxels(id)) least.leaves = 0;
        return least;
    }

    Placed place_built(Traversal traversal) {
        Placed failed{.traversal = traversal, .reason = misfit(least_bytes(traversal), limits_)};
        if (!failed.reason.empty()) return failed;
        try {
            const Stopwatch watch;
            const MarchWorld built = build_march_world(scene_.world, traversal);
            return place(built, watch.elapsed().cpu);
        } catch (const Error& error) {
            if (error.code() != ExitCode::out_of_memory) throw;
            failed.reason = error.what();
            return failed;
        }
    }

    Placed place(const MarchWorld& built, double build_s) {
        Placed placed{.traversal = built.traversal,
                      .bytes = bytes_of(built),
                      .chunks = built.chunks_size,
                      .build_s = build_s};
        placed.reason = misfit(placed.bytes, limits_);
        if (!placed.reason.empty()) return placed;
        upload<std::uint32_t>(structure_buffer(built.traversal, "roots"), built.roots, executor_);
        upload<std::uint32_t>(structure_buffer(built.traversal, "nodes"), built.nodes, executor_);
        upload<std::uint32_t>(structure_buffer(built.traversal, "leaves"), built.leaves, executor_);
        return placed;
    }

    std::vector<Measured> plan_rows() const {
        std::vector<Measured> all;
        for (const Placed& placed : structures_) {
            for (const RayList& rays : rays_) {
                const BenchRow row{
                    .scene = scene_.name,
                    .extent = scene_.extent,
                    .traversal = std::string(name_of(placed.traversal)),
                    .rays = std::string(name_of(rays.kind)),
                    .reason = placed.reason,
                    .count = rays.count,
                    .memory_bytes = placed.bytes.roots + placed.bytes.nodes + placed.bytes.leaves,
                    .build_s = placed.build_s,
                    .checked = rays.verdicts.rays.size()};
                all.push_back({.row = row, .structure = &placed, .rays = &rays});
            }
        }
        return all;
    }

    // Compiles the shader, judges its hits and finds out how often to repeat it.
    void prepare(Measured& one) {
        if (one.row.count == 0) return;
        Recording recording = record_march(one, 1);
        recording.readback(hits_buffer(one.rays->kind));
        const RunResult result = executor_.run(recording);
        const std::vector<std::byte>& bytes = result.readbacks.at(hits_buffer(one.rays->kind));
        std::vector<gpu::BenchHit> hits(one.row.count);
        std::memcpy(hits.data(), bytes.data(), bytes.size());
        one.row.mismatches = count_mismatches(one.rays->verdicts, hits);
        double steps = 0.0;
        for (const gpu::BenchHit& hit : hits)
            steps += hit.steps;
        one.row.steps = steps / static_cast<double>(one.row.count);
        const double once = std::max(run_once(one).cpu, 1e-6);
        one.repeats =
            static_cast<std::uint32_t>(std::clamp(std::ceil(kLeastRunCpuS / once), 1.0, kMostRepeats));
    }

    void measure(Measured& one) {
        const Seconds taken = run_once(one);
        one.best.cpu = std::min(one.best.cpu, taken.cpu / one.repeats);
        one.best.wall = std::min(one.best.wall, taken.wall / one.repeats);
    }

    Seconds run_once(const Measured& one) {
        const Recording recording = record_march(one, one.repeats);
        const Stopwatch watch;
        executor_.run(recording);
        return watch.elapsed();
    }

    Recording record_march(const Measured& one, std::uint32_t repeats) const {
        const RayKind kind = one.rays->kind;
        const Placed& placed = *one.structure;
        Recording recording;
        const auto use = [&](const std::string& name, std::uint64_t bytes) {
            recording.declare(
                {.name = name, .size_bytes = std::max<std::uint64_t>(bytes, 4), .persistent = true});
            return name;
        };
        const Dispatch dispatch{
            .label = "bench.march",
            .shader = "bench_march",
            .extent = {one.row.count == 0 ? 1 : static_cast<std::uint32_t>(one.row.count), 1, 1},
            .bindings = {{"Roots", use(structure_buffer(placed.traversal, "roots"), placed.bytes.roots)},
                         {"Nodes", use(structure_buffer(placed.traversal, "nodes"), placed.bytes.nodes)},
                         {"Leaves", use(structure_buffer(placed.traversal, "leaves"), placed.bytes.leaves)},
                         {"Rays", use(rays_buffer(kind), one.row.count * sizeof(gpu::Ray))},
                         {"BenchHits", use(hits_buffer(kind), one.row.count * sizeof(gpu::BenchHit))}},
            .constants = {{"traversal", static_cast<std::uint32_t>(placed.traversal)}},
            .push = to_bytes(gpu::BenchMarchPush{static_cast<gpu::uint>(one.row.count), placed.chunks})};
        for (std::uint32_t i = 0; i < repeats; ++i)
            recording.dispatch(dispatch);
        return recording;
    }

    static BenchRow finished_row(const Measured& one) {
        BenchRow row = one.row;
        if (!row.reason.empty() || row.count == 0) return row;
        const double million = static_cast<double>(row.count) * 1e-6;
        row.mrays_per_cpu_s = million / one.best.cpu;
        row.mrays_per_s = million / one.best.wall;
        return row;
    }

    const BenchScene& scene_;
    const BenchRequest& request_;
    const DeviceLimits& limits_;
    Executor executor_;
    std::vector<RayList> rays_;
    std::vector<Placed> structures_;
};

}  // namespace

std::vector<BenchRow> bench_march(const BenchScene& scene, std::span<const Traversal> traversals,
                                  const BenchRequest& request, Device& device) {
    return MarchBench(scene, request, device).run(traversals);
}

}  // namespace voxilux
