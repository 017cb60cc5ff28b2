#include "renderer/slices.h"

#include <algorithm>

namespace voxilux {
namespace {

// A GPU may take 250 ms at most for one dispatch; half of it leaves room for slices of uneven cost. On a CPU
// only the answer to Ctrl-C and to a time limit matters.
constexpr double kGpuTargetMs = 125.0;
constexpr double kCpuTargetMs = 400.0;
// Rays of the first slice, before anything is known: 80 ms at 50 million rays per second.
constexpr std::uint64_t kFirstSliceRays = std::uint64_t{1} << 22;
constexpr double kMaxGrowth = 4.0;
constexpr std::uint32_t kGroupRows = 16;  // whole workgroups keep their lanes busy

}  // namespace

SliceGovernor::SliceGovernor(const RenderPlan& plan, bool is_cpu)
    : height_(static_cast<std::uint32_t>(plan.settings.size.y)),
      band_rows_(plan.band_rows),
      most_rows_(plan.slice_rows),
      target_ms_(is_cpu ? kCpuTargetMs : kGpuTargetMs) {
    const std::uint64_t rays_per_pixel = 2 + (plan.has(Effect::ao) ? plan.settings.ao_rays : 0);
    const std::uint64_t rays_per_row = rays_per_pixel * static_cast<std::uint64_t>(plan.settings.size.x);
    keeps_whole_ = plan.any(&Technique::whole_frame) || plan.any(&Technique::whole_slices);
    if (keeps_whole_) {
        rows_ = height_;
        return;
    }
    rows_ = static_cast<std::uint32_t>(
        std::clamp<std::uint64_t>(kFirstSliceRays / rays_per_row, 1, std::uint64_t{most_rows_}));
}

void SliceGovernor::adapt(std::uint32_t rows_done, double max_ms) {
    if (keeps_whole_ || max_ms <= 0.0) return;
    const double ideal = static_cast<double>(rows_done) * target_ms_ / max_ms;
    const double grown = std::min(ideal, kMaxGrowth * static_cast<double>(rows_));
    const auto wanted = static_cast<std::uint32_t>(std::clamp(grown, 1.0, static_cast<double>(most_rows_)));
    rows_ = wanted >= kGroupRows && wanted < most_rows_ ? wanted / kGroupRows * kGroupRows : wanted;
}

Slice SliceGovernor::slice_at(std::uint32_t row, std::uint32_t max_rows) const {
    const std::uint32_t band = row / band_rows_;
    const std::uint32_t band_end = std::min(height_, (band + 1) * band_rows_);
    const std::uint32_t rows = keeps_whole_ ? rows_ : std::clamp(max_rows, 1u, rows_);
    return {.band = band,
            .band_first_row = band * band_rows_,
            .first_row = row,
            .row_count = std::min(rows, band_end - row)};
}

}  // namespace voxilux
