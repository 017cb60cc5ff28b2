// `voxilux bench march` with others in the contest for the same rays: the best that Embree does, ray by ray
// or in packets, and the march itself as scalar C++ for this machine, each on one thread. Not a test: it is
// built where Embree is installed.

#include <CLI/CLI.hpp>
#include <algorithm>

#include "bench/bench.h"
#include "bench/embree_scene.h"
#include "bench/native_march.h"
#include "bench/rate_ratios.h"
#include "exit_message.h"

namespace voxilux {
namespace {

struct RayList {
    RayKind kind;
    std::vector<gpu::Ray> rays;
    std::vector<gpu::BenchHit> marched;  // what the march finds
};

bool is_hit(const gpu::BenchHit& hit) {
    return hit.face != gpu::kFaceMiss;
}

// Rays whose outcome differs from the march's. Embree's arithmetic is not exact: rays that graze an edge may
// differ.
std::uint64_t count_differences(bool any_hit, std::span<const gpu::BenchHit> hits,
                                std::span<const gpu::BenchHit> marched) {
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < hits.size(); ++i) {
        const bool same = any_hit || !is_hit(hits[i]) || !is_hit(marched[i]) ||
                          (hits[i].cell == marched[i].cell && hits[i].face == marched[i].face);
        if (is_hit(hits[i]) != is_hit(marched[i]) || !same) ++count;
    }
    return count;
}

bool has_native_march(Traversal traversal) {
    return traversal == Traversal::naadf || has_free_boxes(traversal);
}

// Contestants on one thread of the CPU.
class CpuBench {
  public:
    CpuBench(const BenchScene& scene, const MarchBenchOptions& options)
        : scene_(scene), embree_(scene.world) {
        const MarchWorld guide = build_march_world(scene.world);
        for (const RayKind kind : options.kinds) {
            RayList list{.kind = kind, .rays = bench_rays(scene, guide, kind, options.size, options.seed)};
            list.marched.resize(list.rays.size());
            march_native(guide, list.rays, list.marched);
            lists_.push_back(std::move(list));
        }
        for (const Traversal traversal : options.traversals)
            if (has_native_march(traversal)) worlds_.push_back(build_march_world(scene.world, traversal));
    }

    // A row for each structure or query of Embree and each kind of rays. They must not outlive this.
    std::vector<MarchContestant> contestants() {
        std::vector<MarchContestant> all;
        for (const MarchWorld& world : worlds_)
            for (const RayList& list : lists_)
                all.push_back(contestant(fmt::format("native.{}", name_of(world.traversal)),
                                         world.size_bytes(), false, list,
                                         [&world, &list](std::span<gpu::BenchHit> hits) {
                                             march_native(world, list.rays, hits);
                                         }));
        for (const EmbreeQuery& query : embree_.queries())
            for (const RayList& list : lists_)
                if (!query.any_hit || list.kind != RayKind::primary)
                    all.push_back(contestant(query.name(), embree_.bytes(), query.any_hit, list,
                                             embree_.prepare(query, list.rays)));
        return all;
    }

  private:
    using Answer = EmbreeScene::Answer;

    MarchContestant contestant(const std::string& name, std::uint64_t memory_bytes, bool any_hit,
                               const RayList& list, const Answer& answer) {
        MarchContestant made{.row = {.scene = scene_.name,
                                     .extent = scene_.extent,
                                     .traversal = name,
                                     .rays = std::string(name_of(list.kind)),
                                     .count = list.rays.size(),
                                     .memory_bytes = memory_bytes,
                                     .checked = list.rays.size()}};
        if (list.rays.empty()) return made;
        hits_.resize(list.rays.size());
        answer(hits_);
        made.row.mismatches = count_differences(any_hit, hits_, list.marched);
        made.run = [this, &list, answer](std::uint32_t repeats) {
            hits_.resize(list.rays.size());
            const Stopwatch watch;
            for (std::uint32_t i = 0; i < repeats; ++i)
                answer(hits_);
            return watch.elapsed();
        };
        return made;
    }

    const BenchScene& scene_;
    EmbreeScene embree_;
    std::vector<RayList> lists_;
    std::vector<MarchWorld> worlds_;
    std::vector<gpu::BenchHit> hits_;
};

std::vector<BenchRow> bench_all(const BenchScene& scene, const MarchBenchOptions& options, Device& device) {
    MarchBench march(scene, options, device);
    CpuBench cpu(scene, options);
    std::vector<MarchContestant> contestants = march.contestants();
    std::ranges::move(cpu.contestants(), std::back_inserter(contestants));
    run_contest(contestants, options.rounds);
    fmt::print(stderr, "{}", describe_ratios(contestants));
    return rows_of(contestants);
}

int run(int argc, char** argv) {
    CLI::App app{"voxilux bench march with Embree and plain C++ in the contest, on one thread."};
    app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    BenchMarchCommand command;
    Flags flags(app);
    add_bench_march_flags(flags, command);
    CLI11_PARSE(app, argc, argv);
    MarchBenchOptions options = command.options;
    options.size = command.inputs.size;
    options.seed = command.inputs.seed;
    options.has_beams = true;
    Device device = open_device({.selector = command.inputs.device});
    bench_march_scenes(command, [&](const BenchScene& scene) { return bench_all(scene, options, device); });
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
