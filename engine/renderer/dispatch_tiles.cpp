#include "renderer/dispatch_tiles.h"

#include <algorithm>

namespace voxilux {
namespace {

// A GPU may take 250 ms at most for one dispatch; half of it leaves room for tiles of uneven cost. On a CPU
// only the response to Ctrl-C and to a time limit matters.
constexpr double kGpuTargetMs = 125.0;
constexpr double kCpuTargetMs = 400.0;
// Rays of the first tile, before anything is known: 80 ms at 50 million rays per second.
constexpr std::uint64_t kFirstTileRays = std::uint64_t{1} << 22;
constexpr std::uint64_t kRaysOfPath = 16;  // what a path of eight surfaces takes
constexpr double kMaxGrowth = 4.0;
constexpr std::uint32_t kGroupRows = 16;  // whole workgroups keep their lanes busy

}  // namespace

TileGovernor::TileGovernor(const RenderPlan& plan, bool is_cpu)
    : height_(static_cast<std::uint32_t>(plan.settings.size.y)),
      film_tile_rows_(plan.film_tile_rows),
      max_rows_(plan.tile_rows),
      target_ms_(is_cpu ? kCpuTargetMs : kGpuTargetMs) {
    const std::uint64_t rays_per_pixel =
        2 + (plan.has(Effect::ao) ? plan.settings.ao_rays : 0) + (plan.paths.runs() ? kRaysOfPath : 0);
    const std::uint64_t rays_per_row = rays_per_pixel * static_cast<std::uint64_t>(plan.settings.size.x);
    keeps_whole_ = plan.any(&Technique::whole_frame) || plan.any(&Technique::whole_tiles);
    if (keeps_whole_) {
        rows_ = height_;
        return;
    }
    rows_ = static_cast<std::uint32_t>(
        std::clamp<std::uint64_t>(kFirstTileRays / rays_per_row, 1, std::uint64_t{max_rows_}));
}

void TileGovernor::adapt(std::uint32_t rows_done, double max_ms) {
    if (keeps_whole_ || max_ms <= 0.0) return;
    const double ideal = static_cast<double>(rows_done) * target_ms_ / max_ms;
    const double grown = std::min(ideal, kMaxGrowth * static_cast<double>(rows_));
    const auto wanted = static_cast<std::uint32_t>(std::clamp(grown, 1.0, static_cast<double>(max_rows_)));
    rows_ = wanted >= kGroupRows && wanted < max_rows_ ? wanted / kGroupRows * kGroupRows : wanted;
}

DispatchTile TileGovernor::tile_at(std::uint32_t row, std::uint32_t max_rows) const {
    const std::uint32_t film_tile = row / film_tile_rows_;
    const std::uint32_t film_tile_end = std::min(height_, (film_tile + 1) * film_tile_rows_);
    const std::uint32_t rows = keeps_whole_ ? rows_ : std::clamp(max_rows, 1u, rows_);
    return {.film_tile = film_tile,
            .film_tile_first_row = film_tile * film_tile_rows_,
            .first_row = row,
            .row_count = std::min(rows, film_tile_end - row)};
}

}  // namespace voxilux
