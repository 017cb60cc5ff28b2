// `voxilux bench march` with Embree in the comparison: the same rays, one at a time on one thread, as a
// program without a GPU would trace them. Not a test: it is built where Embree is installed.

#include <xmmintrin.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>

#include "bench/bench.h"
#include "bench/embree_scene.h"
#include "exit_message.h"
#include "world/world_view.h"  // gives camera.h the world that it marches

#include "shared/camera.h"

namespace voxilux {
namespace {

// Denormals count as zero while this lives, as Embree's manual asks. The march needs them.
class FlushDenormals {
  public:
    FlushDenormals() { _mm_setcsr(before_ | kFlushToZero | kDenormalsAreZero); }
    FlushDenormals(const FlushDenormals&) = delete;
    FlushDenormals& operator=(const FlushDenormals&) = delete;
    ~FlushDenormals() { _mm_setcsr(before_); }

  private:
    static constexpr unsigned kFlushToZero = 0x8000;
    static constexpr unsigned kDenormalsAreZero = 0x0040;
    unsigned before_ = _mm_getcsr();
};

struct RayList {
    RayKind kind;
    std::vector<gpu::Ray> rays;
    std::vector<gpu::BenchHit> marched;  // what the march finds
};

enum class Query : std::uint8_t { intersect1, occluded1 };

bool is_hit(const gpu::BenchHit& hit) {
    return hit.face != gpu::kFaceMiss;
}

gpu::BenchHit march_one(const MarchWorld& guide, const gpu::Ray& ray) {
    const gpu::WorldEntry entry = gpu::enter_world(ray, guide.size());
    if (!entry.enters) return {.face = gpu::kFaceMiss};
    const gpu::MarchHit hit = gpu::march(guide, entry.ray, guide.chunks_size);
    return {.cell = hit.cell, .face = hit.face, .t = entry.t + hit.t, .steps = hit.steps};
}

// Rays whose outcome differs from the march's. Embree's arithmetic is not exact: rays that graze an edge may
// differ.
std::uint64_t count_differences(Query query, std::span<const gpu::BenchHit> hits,
                                std::span<const gpu::BenchHit> marched) {
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < hits.size(); ++i) {
        const bool same = query == Query::occluded1 || !is_hit(hits[i]) || !is_hit(marched[i]) ||
                          (hits[i].cell == marched[i].cell && hits[i].face == marched[i].face);
        if (is_hit(hits[i]) != is_hit(marched[i]) || !same) ++count;
    }
    return count;
}

class EmbreeBench {
  public:
    EmbreeBench(const BenchScene& scene, const MarchBenchOptions& options)
        : scene_(scene), embree_(scene.world) {
        build_s_ = build_watch_.elapsed().cpu;
        const MarchWorld guide = build_march_world(scene.world);
        for (const RayKind kind : options.kinds) {
            RayList list{.kind = kind, .rays = bench_rays(scene, guide, kind, options.size, options.seed)};
            for (const gpu::Ray& ray : list.rays)
                list.marched.push_back(march_one(guide, ray));
            lists_.push_back(std::move(list));
        }
    }

    // A row for each query and kind of rays; reports on standard error how many rays hit. The arguments must
    // outlive this.
    std::vector<MarchContestant> contestants() {
        std::vector<MarchContestant> all;
        for (const RayList& list : lists_)
            all.push_back(contestant(Query::intersect1, list));
        for (const RayList& list : lists_)
            if (list.kind != RayKind::primary) all.push_back(contestant(Query::occluded1, list));
        return all;
    }

  private:
    MarchContestant contestant(Query query, const RayList& list) {
        BenchRow row{.scene = scene_.name,
                     .extent = scene_.extent,
                     .traversal = query == Query::occluded1 ? "embree.occluded1" : "embree.intersect1",
                     .rays = std::string(name_of(list.kind)),
                     .count = list.rays.size(),
                     .memory_bytes = embree_.bytes(),
                     .build_s = build_s_,
                     .checked = list.rays.size()};
        if (list.rays.empty()) return {.row = row};
        ask(query, list, 1);
        row.mismatches = count_differences(query, hits_, list.marched);
        fmt::print(stderr, "{} {} {} {}: {} hits, the march finds {}\n", row.scene, row.extent, row.traversal,
                   row.rays, std::ranges::count_if(hits_, is_hit),
                   std::ranges::count_if(list.marched, is_hit));
        return {.row = row,
                .run = [this, query, &list](std::uint32_t repeats) { return ask(query, list, repeats); }};
    }

    Seconds ask(Query query, const RayList& list, std::uint32_t repeats) {
        hits_.resize(list.rays.size());
        const FlushDenormals flush;
        const Stopwatch watch;
        for (std::uint32_t i = 0; i < repeats; ++i) {
            if (query == Query::occluded1)
                embree_.find_occluded(list.rays, hits_);
            else
                embree_.intersect(list.rays, hits_);
        }
        return watch.elapsed();
    }

    const BenchScene& scene_;
    Stopwatch build_watch_;  // starts before what it times
    EmbreeScene embree_;
    double build_s_ = 0.0;
    std::vector<RayList> lists_;
    std::vector<gpu::BenchHit> hits_;
};

bool is_embree(const BenchRow& row) {
    return row.traversal.starts_with("embree.");
}

// The rate of the row over the better one of Embree for the same rays.
double rate_over_embree(const BenchRow& row, const std::vector<BenchRow>& rows) {
    double best = 0.0;
    for (const BenchRow& other : rows)
        if (is_embree(other) && other.rays == row.rays) best = std::max(best, other.mrays_per_cpu_s);
    return row.mrays_per_cpu_s / best;
}

// One line per structure: its rates per CPU second over Embree's, and their geometric mean.
void print_ratios(const std::vector<BenchRow>& rows) {
    for (auto row = rows.begin(); row != rows.end();) {
        const auto end = std::find_if(
            row, rows.end(), [&](const BenchRow& other) { return other.traversal != row->traversal; });
        std::string line;
        double logs = 0.0;
        for (auto one = row; one != end; ++one) {
            const double ratio = rate_over_embree(*one, rows);
            line += fmt::format("  {} {:.2f}", one->rays, ratio);
            logs += std::log(ratio);
        }
        if (!is_embree(*row) && row->reason.empty())
            fmt::print(stderr, "{} {} {} over Embree:{}  mean {:.2f}\n", row->scene, row->extent,
                       row->traversal, line, std::exp(logs / static_cast<double>(end - row)));
        row = end;
    }
}

std::vector<BenchRow> bench_both(const BenchScene& scene, const MarchBenchOptions& options, Device& device) {
    MarchBench march(scene, options, device);
    EmbreeBench embree(scene, options);
    std::vector<MarchContestant> contestants = march.contestants();
    std::ranges::move(embree.contestants(), std::back_inserter(contestants));
    run_contest(contestants, options.rounds);
    const std::vector<BenchRow> rows = rows_of(contestants);
    print_ratios(rows);
    return rows;
}

int run(int argc, char** argv) {
    CLI::App app{"voxilux bench march with Embree in the contest, one ray at a time on one thread."};
    app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    BenchMarchCommand command;
    Flags flags(app);
    add_bench_march_flags(flags, command);
    CLI11_PARSE(app, argc, argv);
    MarchBenchOptions options = command.options;
    options.size = command.inputs.size;
    options.seed = command.inputs.seed;
    Device device = open_device({.selector = command.inputs.device});
    bench_march_scenes(command, [&](const BenchScene& scene) { return bench_both(scene, options, device); });
    return 0;
}

}  // namespace
}  // namespace voxilux

int main(int argc, char** argv) {
    try {
        return voxilux::run(argc, argv);
    } catch (const std::exception& error) {
        const voxilux::ExitMessage message = voxilux::exit_message_of(error);
        fmt::print(stderr, "embree_march: {}\n", message.text);
        return static_cast<int>(message.code);
    }
}
