#include "renderer/film_readback.h"

#include <algorithm>
#include <cstring>

#include "passes/plane.h"
#include "plan/film_planes.h"

namespace voxilux {
namespace {

// Rows of one film plane, film tiles joined.
template <class T>
std::vector<T> read_plane(const RenderPlan& plan, const FilmPlane& plane, RowRange rows, Executor& executor) {
    const std::size_t row_values = static_cast<std::size_t>(plan.settings.size.x) * plane.components;
    std::vector<T> values;
    values.reserve(row_values * rows.count);
    const std::uint32_t end = rows.first + rows.count;
    for (std::uint32_t row = rows.first; row < end;) {
        const std::uint32_t film_tile = row / plan.film_tile_rows;
        const std::uint32_t count = std::min((film_tile + 1) * plan.film_tile_rows, end) - row;
        Recording recording;
        const std::string buffer = film_plane<T>(plan, plane, film_tile, recording);
        recording.readback(buffer, row_values * (row - film_tile * plan.film_tile_rows) * sizeof(T),
                           row_values * count * sizeof(T));
        const RunResult result = executor.run(recording);
        const std::vector<std::byte>& bytes = result.readbacks.at(buffer);
        const std::size_t begin = values.size();
        values.resize(begin + row_values * count);
        std::memcpy(values.data() + begin, bytes.data(), bytes.size());
        row += count;
    }
    return values;
}

RowRange all_rows(const RenderPlan& plan) {
    return {0, static_cast<std::uint32_t>(plan.settings.size.y)};
}

FilmSums empty_film(const RenderPlan& plan, RowRange rows) {
    return {.width = plan.settings.size.x,
            .height = static_cast<int>(rows.count),
            .is_independent = plan.has_independent_samples(),
            .even = std::vector<std::uint32_t>(rows.count, 0),
            .odd = std::vector<std::uint32_t>(rows.count, 0)};
}

}  // namespace

FilmSums read_error_film(const RenderPlan& plan, Executor& executor) {
    const RowRange rows = all_rows(plan);
    FilmSums film = empty_film(plan, rows);
    for (const char* half : {"beauty_a", "beauty_b"})
        film.sums[half] = read_plane<std::int64_t>(plan, {half, 3}, rows, executor);
    if (plan.sums_squares)
        film.sums["squares"] = read_plane<std::int64_t>(plan, {"squares", 3}, rows, executor);
    if (!plan.sums_bias) return film;
    for (const char* half : {"bias_a", "bias_b"})
        film.sums[half] = read_plane<std::int64_t>(plan, {half, 3}, rows, executor);
    return film;
}

RowRange middle_rows(const RenderPlan& plan, std::uint32_t count) {
    const auto height = static_cast<std::uint32_t>(plan.settings.size.y);
    const std::uint32_t film_tile = height / 2 / plan.film_tile_rows;
    const std::uint32_t film_tile_first = film_tile * plan.film_tile_rows;
    const std::uint32_t film_tile_count = std::min(plan.film_tile_rows, height - film_tile_first);
    const std::uint32_t rows = std::min(count, film_tile_count);
    const std::uint32_t wanted = std::max(height / 2, film_tile_first + rows / 2) - rows / 2;
    return {std::min(wanted, film_tile_first + film_tile_count - rows), rows};
}

FilmSums read_film(const RenderPlan& plan, Executor& executor) {
    return read_film_rows(plan, all_rows(plan), executor);
}

FilmSums read_film_rows(const RenderPlan& plan, RowRange rows, Executor& executor) {
    FilmSums film = empty_film(plan, rows);
    for (const FilmPlane& plane : film_planes(plan))
        film.sums[plane.name] = read_plane<std::int64_t>(plan, plane, rows, executor);
    if (!plan.has(Effect::aov)) return film;
    film.firsts["position"] = read_plane<float>(plan, {"position", 3}, rows, executor);
    film.firsts["depth"] = read_plane<float>(plan, {"depth", 1}, rows, executor);
    return film;
}

}  // namespace voxilux
