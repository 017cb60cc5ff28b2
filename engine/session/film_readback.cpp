#include "session/film_readback.h"

#include <algorithm>
#include <cstring>

#include "passes/plane.h"
#include "plan/film_planes.h"

namespace voxilux {
namespace {

// One film quantity over the whole picture, bands joined.
template <class T>
std::vector<T> read_plane(const RenderPlan& plan, const std::string& name, std::size_t components,
                          Executor& executor) {
    const auto row = static_cast<std::size_t>(plan.settings.size.x) * components;
    std::vector<T> values;
    values.reserve(row * static_cast<std::size_t>(plan.settings.size.y));
    for (std::uint32_t band = 0; band < plan.band_count; ++band) {
        const std::uint32_t first = band * plan.band_rows;
        const std::uint32_t rows =
            std::min(plan.band_rows, static_cast<std::uint32_t>(plan.settings.size.y) - first);
        Recording recording;
        const std::string buffer = use_buffer(plan, film_buffer(name, band), recording);
        recording.readback(buffer, 0, row * rows * sizeof(T));
        const RunResult result = executor.run(recording);
        const std::vector<std::byte>& bytes = result.readbacks.at(buffer);
        const std::size_t begin = values.size();
        values.resize(begin + row * rows);
        std::memcpy(values.data() + begin, bytes.data(), bytes.size());
    }
    return values;
}

FilmSums empty_film(const RenderPlan& plan) {
    const auto rows = static_cast<std::size_t>(plan.settings.size.y);
    return {.width = plan.settings.size.x,
            .height = plan.settings.size.y,
            .is_independent = plan.has_independent_samples(),
            .even = std::vector<std::uint32_t>(rows, 0),
            .odd = std::vector<std::uint32_t>(rows, 0)};
}

}  // namespace

FilmSums read_error_film(const RenderPlan& plan, Executor& executor) {
    FilmSums film = empty_film(plan);
    for (const char* half : {"beauty_a", "beauty_b"})
        film.sums[half] = read_plane<std::int64_t>(plan, half, 3, executor);
    if (plan.sums_squares) film.sums["squares"] = read_plane<std::int64_t>(plan, "squares", 3, executor);
    if (!plan.sums_bias) return film;
    for (const char* half : {"bias_a", "bias_b"})
        film.sums[half] = read_plane<std::int64_t>(plan, half, 3, executor);
    return film;
}

FilmSums read_film(const RenderPlan& plan, Executor& executor) {
    FilmSums film = empty_film(plan);
    for (const FilmPlane& plane : film_planes(plan))
        film.sums[plane.name] = read_plane<std::int64_t>(plan, plane.name, plane.components, executor);
    if (!plan.has(Effect::aov)) return film;
    film.firsts["position"] = read_plane<float>(plan, "position", 3, executor);
    film.firsts["depth"] = read_plane<float>(plan, "depth", 1, executor);
    return film;
}

}  // namespace voxilux
