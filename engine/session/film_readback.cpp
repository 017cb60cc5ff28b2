#include "session/film_readback.h"

#include <algorithm>
#include <cstring>
#include <span>

#include "passes/plane.h"
#include "plan/film_planes.h"

namespace voxilux {
namespace {

struct Halves {
    std::vector<std::int64_t> a;
    std::vector<std::int64_t> b;
    std::vector<std::uint64_t> a_samples;  // per pixel
    std::vector<std::uint64_t> b_samples;

    [[nodiscard]] FilmHalf half_a() const { return {a, a_samples}; }
    [[nodiscard]] FilmHalf half_b() const { return {b, b_samples}; }
};

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

std::vector<std::uint64_t> spread_rows(const RenderPlan& plan, const RowSamples& samples, std::uint32_t odd) {
    std::vector<std::uint64_t> counts;
    counts.reserve(samples.size() * static_cast<std::size_t>(plan.settings.size.x));
    for (const std::uint32_t n : samples)
        counts.insert(counts.end(), static_cast<std::size_t>(plan.settings.size.x), (n + 1 - odd) / 2);
    return counts;
}

Halves read_halves(const RenderPlan& plan, const RowSamples& samples, Executor& executor) {
    return {read_plane<std::int64_t>(plan, "beauty_a", 3, executor),
            read_plane<std::int64_t>(plan, "beauty_b", 3, executor), spread_rows(plan, samples, 0),
            spread_rows(plan, samples, 1)};
}

std::vector<float> mean_of(const RenderPlan& plan, const RowSamples& samples,
                           std::span<const std::int64_t> sums, std::size_t stride, std::size_t offset) {
    const auto width = static_cast<std::size_t>(plan.settings.size.x);
    std::vector<float> means;
    means.reserve(width * samples.size());
    for (std::size_t row = 0; row < samples.size(); ++row) {
        const auto of_row = sums.subspan(row * width * stride, width * stride);
        const std::vector<float> part = mean_plane(of_row, stride, offset, samples[row]);
        means.insert(means.end(), part.begin(), part.end());
    }
    return means;
}

struct NamedPlane {
    std::string film;
    std::vector<std::string> channels;
};

void add_means(const RenderPlan& plan, const RowSamples& samples, const NamedPlane& plane, Image& image,
               Executor& executor) {
    const std::size_t stride = plane.channels.size();
    const std::vector<std::int64_t> sums = read_plane<std::int64_t>(plan, plane.film, stride, executor);
    for (std::size_t i = 0; i < stride; ++i)
        image.channels[plane.channels[i]] = {Image::Precision::single,
                                             mean_of(plan, samples, sums, stride, i)};
}

void add_first_sample(const RenderPlan& plan, const NamedPlane& plane, Image& image, Executor& executor) {
    const std::size_t stride = plane.channels.size();
    const std::vector<float> values = read_plane<float>(plan, plane.film, stride, executor);
    for (std::size_t i = 0; i < stride; ++i) {
        std::vector<float> channel(values.size() / stride);
        for (std::size_t pixel = 0; pixel < channel.size(); ++pixel)
            channel[pixel] = values[pixel * stride + i];
        image.channels[plane.channels[i]] = {Image::Precision::single, std::move(channel)};
    }
}

}  // namespace

ErrorEstimate read_error(const RenderPlan& plan, const RowSamples& samples, Executor& executor) {
    const Halves halves = read_halves(plan, samples, executor);
    return estimate_error(plan.settings.size.x, plan.settings.size.y, halves.half_a(), halves.half_b());
}

FilmReadback read_film(const RenderPlan& plan, const RowSamples& samples, Executor& executor) {
    const Halves halves = read_halves(plan, samples, executor);
    const int width = plan.settings.size.x;
    const int height = plan.settings.size.y;
    FilmReadback film{film_image(width, height, halves.half_a(), halves.half_b()),
                      estimate_error(width, height, halves.half_a(), halves.half_b())};
    if (!plan.has(Effect::aov)) return film;
    add_means(plan, samples, {"albedo", {"albedo.R", "albedo.G", "albedo.B"}}, film.image, executor);
    add_means(plan, samples, {"normal", {"N.X", "N.Y", "N.Z"}}, film.image, executor);
    if (plan.has(Effect::ao)) add_means(plan, samples, {"ao", {"ao.Y"}}, film.image, executor);
    if (plan.has(Effect::sun)) add_means(plan, samples, {"sun", {"sun.Y"}}, film.image, executor);
    add_first_sample(plan, {"position", {"P.X", "P.Y", "P.Z"}}, film.image, executor);
    add_first_sample(plan, {"depth", {"Z"}}, film.image, executor);
    return film;
}

}  // namespace voxilux
