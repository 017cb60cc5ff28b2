#include "jobs/bench/ao_bench.h"

#include <algorithm>
#include <limits>
#include <tuple>

#include "base/median.h"
#include "jobs/bench/contest.h"

namespace voxilux {
namespace {

// Frames whose error is measured: powers of 4, and the last one.
std::vector<int> measured_frames(int frames) {
    std::vector<int> measured;
    for (int frame = 1; frame < frames; frame *= 4)
        measured.push_back(frame);
    measured.push_back(frames);
    return measured;
}

// References, shared by variants whose camera sees the same.
class References {
  public:
    References(AoStage& stage, std::uint32_t rays) : stage_(stage), rays_(rays) {}

    const AoReference& at(const AoTake& take, int frame) {
        const bool is_start = take.motion == Motion::still || take.motion == Motion::floor || frame == 1;
        const Sequence sequence = take.variant.sequence;
        const std::tuple view(is_start ? Motion::still : take.motion, is_start ? 1 : frame, sequence);
        const auto known = known_.find(view);
        if (known != known_.end()) return known->second;
        return known_.emplace(view, stage_.reference(take.motion, frame, sequence, rays_)).first->second;
    }

    [[nodiscard]] std::uint32_t rays() const { return rays_; }

  private:
    AoStage& stage_;
    std::uint32_t rays_;
    std::map<std::tuple<Motion, int, Sequence>, AoReference> known_;
};

AoTake take_of(const AoVariant& variant, Motion motion, const AoBenchOptions& options) {
    AoTake take{.variant = variant, .motion = motion, .frames = options.frames};
    if (motion == Motion::floor) {
        take.frames = kFloorFrames;
        take.rays = kFloorRays;
    }
    return take;
}

void set_errors(AoRow& row, const AoTake& take, const AoFootage& footage, References& references) {
    for (const int frame : measured_frames(row.frames))
        row.errors.push_back({frame, rmse_over(references.at(take, frame), footage.visibility.at(frame))});
    row.reference_noise = noise_bound(references.at(take, row.frames), references.rays());
}

void set_counts(AoRow& row, const AoFootage& footage) {
    const AoWork& work = footage.rest.frames > 0 ? footage.rest : footage.first;
    row.rays = work.mean(gpu::kWorkAoRays);
    row.searched_percent = searched_percent(work);
    row.probes_per_search = probes_per_search(work);
    row.table_full = work.mean(gpu::kFaultAoTableFull);
    if (footage.slots == 0) return;
    row.atomics = atomics_per_frame(work, row.rays_per_pixel);
    const auto all = [&](std::size_t index) {
        return footage.first.counts[index] + footage.rest.counts[index];
    };
    row.cells = all(gpu::kWorkAoClaimed) - all(gpu::kWorkAoEvicted);
    row.load = static_cast<double>(row.cells) / footage.slots;
}

// Keeps the better times of a row and a new round.
void take_times(AoRow& row, const AoFootage& footage) {
    std::map<std::string, std::vector<double>> ms;
    std::vector<double> cpu_ms;
    const std::size_t frames = footage.passes.size();
    for (std::size_t i = frames / 2; i < frames; ++i) {
        cpu_ms.push_back(1e3 * footage.seconds[i].cpu);
        for (const AoPassTime& pass : footage.passes[i])
            ms[pass.label].push_back(pass.ms);
    }
    row.cpu_ms = std::min(row.cpu_ms, median(cpu_ms));
    for (const auto& [label, times] : ms) {
        const double time = median(times);
        const auto known = std::ranges::find(row.passes, label, &AoPassTime::label);
        if (known == row.passes.end())
            row.passes.push_back({label, time});
        else
            known->ms = std::min(known->ms, time);
    }
}

// The row of a first round: quality and counts are the same in all rounds. Brute force repeats its rays, so
// it has no meaningful flicker.
AoRow measure(const AoTake& take, AoStage& stage, References& references) {
    AoTake kept = take;
    for (const int frame : measured_frames(take.frames))
        kept.kept.insert(frame);
    const bool flickers =
        take.motion == Motion::still && take.frames > 1 && take.variant.ao.method != AoMethod::brute;
    if (flickers) kept.kept.insert(take.frames - 1);
    const AoFootage footage = stage.play(kept);
    AoRow row{.motion = std::string(name_of(take.motion)),
              .variant = take.variant.name,
              .frames = take.frames,
              .rays_per_pixel = take.rays,
              .cpu_ms = std::numeric_limits<double>::infinity()};
    set_errors(row, take, footage, references);
    set_counts(row, footage);
    take_times(row, footage);
    if (flickers) {
        row.flicker = mean_change(footage.visibility.at(take.frames - 1), footage.visibility.at(take.frames),
                                  references.at(take, take.frames).pixels);
    }
    return row;
}

struct AoContestant {
    AoTake take;
    AoStage& stage;
    References& references;
    AoRow row;

    void warm_up() { row = measure(take, stage, references); }
    void take_turn() { take_times(row, stage.play(take)); }
};

}  // namespace

std::vector<AoRow> bench_ao(const std::string& name, AoStage& stage, const AoBenchOptions& options) {
    References references(stage, options.reference_rays);
    std::vector<AoRow> rows;
    for (const Motion motion : options.motions) {
        std::vector<AoContestant> contestants;
        for (const AoVariant& variant : options.variants) {
            if (motion == Motion::floor && !sets_only_width(variant)) continue;
            contestants.push_back({take_of(variant, motion, options), stage, references, {}});
        }
        run_contest(contestants, motion == Motion::floor ? 0 : options.rounds - 1);
        std::ranges::move(rows_of(contestants), std::back_inserter(rows));
    }
    for (AoRow& row : rows)
        row.scene = name;
    return rows;
}

}  // namespace voxilux
