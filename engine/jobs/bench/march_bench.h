#pragma once

#include <vector>

#include "jobs/bench/bench_rays.h"
#include "jobs/bench/bench_row.h"
#include "jobs/bench/bench_scene.h"
#include "jobs/bench/contest.h"
#include "jobs/bench/placed_structure.h"
#include "jobs/bench/ray_checker.h"

namespace voxilux {

struct MarchBenchOptions {
    std::vector<Traversal> traversals{all_traversals().begin(), all_traversals().end()};
    std::vector<RayKind> kinds{kRayKinds.begin(), kRayKinds.end()};
    Builder builder = Builder::cpu;
    glm::ivec2 size{640, 360};  // pixels
    int rounds = 5;             // each row takes the best
    bool has_beams = false;     // camera rays also start where beams end, in rows of their own
    std::uint32_t seed = 0;
};

// The rays of a scene and the structures to march them through, on the device.
class MarchBench {
  public:
    // Throws Error(out_of_memory) when the device cannot bind the rays.
    MarchBench(const BenchScene& scene, const MarchBenchOptions& options, Device& device);

    // A contestant for each structure and kind of rays, its hits checked; structures that the device cannot
    // bind give rows with a reason. Contestants must not outlive this.
    [[nodiscard]] std::vector<MarchContestant> contestants();

  private:
    // The rays of one kind on the device, and the expected hits of some of them.
    struct RayList {
        RayKind kind;
        std::uint32_t count = 0;
        Verdicts verdicts;
    };

    [[nodiscard]] RayList place_rays(RayKind kind, const std::vector<gpu::Ray>& rays,
                                     const DeviceLimits& limits);
    // Rays through a structure, from where beams end or from where they are.
    struct March {
        const PlacedStructure& structure;
        const RayList& rays;
        bool has_beams;
    };
    [[nodiscard]] bool can_start_at_beams(const PlacedStructure& structure, const RayList& rays) const;
    [[nodiscard]] MarchContestant contestant(const March& march);
    [[nodiscard]] BenchRow row_of(const March& march) const;
    void judge(BenchRow& row, const March& march);
    Seconds run(const March& march, std::uint32_t repeats);
    [[nodiscard]] Recording record(const March& march, std::uint32_t repeats) const;
    [[nodiscard]] Dispatch beam_dispatch(const PlacedStructure& structure, const std::string& starts,
                                         Recording& recording) const;

    const BenchScene& scene_;
    bool has_beams_;
    gpu::FrameParams frame_;
    Executor executor_;
    std::vector<RayList> rays_;
    std::vector<PlacedStructure> structures_;
};

// Marches all of it and returns the rows.
[[nodiscard]] std::vector<BenchRow> bench_march(const BenchScene& scene, const MarchBenchOptions& options,
                                                Device& device);

}  // namespace voxilux
