#include "passes/film/film_add.h"

#include "base/checked_cast.h"
#include "shared/gpu_types.h"

namespace voxilux {
namespace {

gpu::FilmAddPush sums_of_tile(const RenderPlan& plan, const DispatchTile& tile, const FilmPlane& film,
                              const Plane& values) {
    const auto width = static_cast<std::uint32_t>(plan.settings.size.x);
    const std::uint32_t row_values = width * film.components;
    return {.count = row_values * tile.row_count,
            .values_stride = values.stride,
            .first_sum = row_values * (tile.first_row - tile.film_tile_first_row)};
}

}  // namespace

void record_film_add(const RenderPlan& plan, const DispatchTile& tile, const FilmPlane& film,
                     const Plane& values, Recording& recording) {
    const gpu::FilmAddPush push = sums_of_tile(plan, tile, film, values);
    recording.dispatch(
        {.label = "film.add",
         .shader = "film_add",
         .extent = {push.count, 1, 1},
         .bindings = {{"Counters", tally_buffer(recording)},
                      {"Values", values.buffer},
                      {"Sums", film_plane<std::int64_t>(plan, film, tile.film_tile, recording)}},
         .push = to_bytes(push)});
}

void record_film_square(const RenderPlan& plan, const DispatchTile& tile, const FilmPlane& film,
                        const Plane& values, Recording& recording) {
    const gpu::FilmAddPush push = sums_of_tile(plan, tile, film, values);
    recording.dispatch(
        {.label = "film.square",
         .shader = "film_square",
         .extent = {push.count, 1, 1},
         .bindings = {{"Values", values.buffer},
                      {"Sums", film_plane<std::int64_t>(plan, film, tile.film_tile, recording)}},
         .push = to_bytes(push)});
}

}  // namespace voxilux
