// The rays of `voxilux bench march` through Embree: one ray at a time on one thread, what a program without a
// GPU would call. Prints rows of the same form, to be put side by side. Not a test: it is built where Embree
// is installed.

#include <xmmintrin.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <limits>

#include "base/error.h"
#include "bench/bench_flags.h"
#include "bench/embree_scene.h"
#include "bench/stopwatch.h"
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

// One way to ask Embree, for the rays of one kind.
struct Query {
    BenchRow row;
    bool is_occlusion = false;
    const std::vector<gpu::Ray>* rays = nullptr;
    Seconds best{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
};

struct RayList {
    RayKind kind;
    std::vector<gpu::Ray> rays;
    std::vector<gpu::BenchHit> marched;  // what the march finds
};

bool is_hit(const gpu::BenchHit& hit) {
    return hit.face != gpu::kFaceMiss;
}

gpu::BenchHit march_one(const MarchWorld& guide, const gpu::Ray& ray) {
    const gpu::WorldEntry entry = gpu::enter_world(ray, guide.size());
    if (!entry.enters) return {.face = gpu::kFaceMiss};
    const gpu::MarchHit hit = gpu::march(guide, entry.ray, guide.chunks_size);
    return {.cell = hit.cell, .face = hit.face, .t = entry.t + hit.t, .steps = hit.steps};
}

Seconds ask(const EmbreeScene& embree, const Query& query, std::vector<gpu::BenchHit>& hits) {
    hits.resize(query.rays->size());
    const FlushDenormals flush;
    const Stopwatch watch;
    if (query.is_occlusion)
        embree.find_occluded(*query.rays, hits);
    else
        embree.intersect(*query.rays, hits);
    return watch.elapsed();
}

// Rays whose outcome differs from the march's. Embree's arithmetic is not exact: rays that graze an edge may
// differ.
std::uint64_t count_differences(const Query& query, std::span<const gpu::BenchHit> hits,
                                std::span<const gpu::BenchHit> marched) {
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < hits.size(); ++i) {
        const bool same = query.is_occlusion || !is_hit(hits[i]) || !is_hit(marched[i]) ||
                          (hits[i].cell == marched[i].cell && hits[i].face == marched[i].face);
        if (is_hit(hits[i]) != is_hit(marched[i]) || !same) ++count;
    }
    return count;
}

class EmbreeBench {
  public:
    EmbreeBench(const BenchScene& scene, const BenchRequest& request) : scene_(scene), request_(request) {
        const MarchWorld guide = build_march_world(scene.world);
        for (const RayKind kind : request.kinds) {
            RayList list{.kind = kind, .rays = bench_rays(scene, guide, kind, request.size, request.seed)};
            for (const gpu::Ray& ray : list.rays)
                list.marched.push_back(march_one(guide, ray));
            lists_.push_back(std::move(list));
        }
    }

    std::vector<BenchRow> run() {
        const Stopwatch watch;
        const EmbreeScene embree(scene_.world);
        build_s_ = watch.elapsed().cpu;
        std::vector<Query> queries = plan_queries(embree);
        std::vector<gpu::BenchHit> hits;
        for (Query& query : queries) {
            ask(embree, query, hits);
            judge(query, hits);
        }
        for (int round = 0; round < request_.rounds; ++round) {
            for (Query& query : queries) {
                const Seconds taken = ask(embree, query, hits);
                query.best = {std::min(query.best.cpu, taken.cpu), std::min(query.best.wall, taken.wall)};
            }
        }
        std::vector<BenchRow> rows;
        for (Query& query : queries) {
            const double million = static_cast<double>(query.rays->size()) * 1e-6;
            query.row.mrays_per_cpu_s = million / query.best.cpu;
            query.row.mrays_per_s = million / query.best.wall;
            rows.push_back(query.row);
        }
        return rows;
    }

  private:
    std::vector<Query> plan_queries(const EmbreeScene& embree) const {
        std::vector<Query> queries;
        for (const bool is_occlusion : {false, true}) {
            for (const RayList& list : lists_) {
                if (is_occlusion && list.kind == RayKind::primary) continue;
                queries.push_back(
                    {.row = {.scene = scene_.name,
                             .extent = scene_.extent,
                             .traversal = is_occlusion ? "embree.occluded1" : "embree.intersect1",
                             .rays = std::string(name_of(list.kind)),
                             .count = list.rays.size(),
                             .memory_bytes = embree.bytes(),
                             .build_s = build_s_,
                             .checked = list.rays.size()},
                     .is_occlusion = is_occlusion,
                     .rays = &list.rays});
            }
        }
        return queries;
    }

    void judge(Query& query, std::span<const gpu::BenchHit> hits) const {
        const auto list =
            std::ranges::find_if(lists_, [&](const RayList& one) { return &one.rays == query.rays; });
        query.row.mismatches = count_differences(query, hits, list->marched);
        fmt::print(stderr, "{} {} {} {}: {} hits, the march finds {}\n", query.row.scene, query.row.extent,
                   query.row.traversal, query.row.rays, std::ranges::count_if(hits, is_hit),
                   std::ranges::count_if(list->marched, is_hit));
    }

    const BenchScene& scene_;
    const BenchRequest& request_;
    std::vector<RayList> lists_;
    double build_s_ = 0.0;
};

int run(int argc, char** argv) {
    CLI::App app{"The rays of voxilux bench march through Embree, one at a time on one thread."};
    BenchFlags flags;
    add_bench_flags(app, flags);
    CLI11_PARSE(app, argc, argv);
    const BenchRequest request = bench_request(flags);
    run_benchmark(flags, [&](const BenchScene& scene) { return EmbreeBench(scene, request).run(); });
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
