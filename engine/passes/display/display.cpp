#include "passes/display/display.h"

#include <algorithm>

#include "passes/plane.h"
#include "plan/film_planes.h"
#include "shared/gpu_types.h"

namespace voxilux {

DisplayBuffer record_display_resolve(const RenderPlan& plan, const SampleCounts& counts,
                                     Recording& recording) {
    const DisplayBuffer display{"display.color", plan.settings.size};
    const auto height = static_cast<std::uint32_t>(display.size.y);
    const std::uint32_t row_values = 3 * static_cast<std::uint32_t>(display.size.x);
    recording.declare({.name = display.buffer,
                       .size_bytes = std::uint64_t{height} * row_values * sizeof(float),
                       .persistent = true});
    for (std::uint32_t film_tile = 0; film_tile < plan.film_tile_count; ++film_tile) {
        const std::uint32_t first_row = film_tile * plan.film_tile_rows;
        const std::uint32_t rows = std::min(plan.film_tile_rows, height - first_row);
        const gpu::DisplayResolvePush push{.count = row_values * rows,
                                           .row_values = row_values,
                                           .first_row = first_row,
                                           .samples = counts.samples,
                                           .rows_ahead = counts.rows_ahead,
                                           .rows_behind = counts.rows_behind};
        recording.dispatch(
            {.label = "display.resolve",
             .shader = "display_resolve",
             .extent = {push.count, 1, 1},
             .bindings = {{"SumsA", film_plane<std::int64_t>(plan, {"beauty_a", 3}, film_tile, recording)},
                          {"SumsB", film_plane<std::int64_t>(plan, {"beauty_b", 3}, film_tile, recording)},
                          {"Display", display.buffer}},
             .push = to_bytes(push)});
    }
    return display;
}

}  // namespace voxilux
