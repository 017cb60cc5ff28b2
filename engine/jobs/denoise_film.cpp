#include "jobs/denoise_film.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string_view>
#include <utility>

#include "base/assert.h"
#include "estimators/bias_estimate.h"
#include "estimators/denoised_error.h"
#include "vk/pass_time.h"

namespace voxilux {
namespace {

constexpr int kErrorReach = 7;  // pixels: errors are averaged over 15 x 15
constexpr std::array<const char*, 4> kGuidePlanes{"guide_sharp", "guide_albedo", "guide_normal",
                                                  "guide_offset"};

const std::vector<std::uint32_t>& rows_of(const FilmSums& film, std::size_t half) {
    return half == 0 ? film.even : film.odd;
}

std::string half_plane(const char* plane, std::size_t half) {
    return std::string(plane) + (half == 0 ? "_a" : "_b");
}

// Reads rows `first` to `first` + `count` - 1 of one half.
class HalfReader {
  public:
    HalfReader(const FilmSums& film, std::size_t half) : film_(film), half_(half) {}

    [[nodiscard]] DenoiseHalf read(int first, int count) const {
        DenoiseHalf rows{.reflected = plane("beauty", first, count),
                         .sharp = plane("guide_sharp", first, count),
                         .albedo = plane("guide_albedo", first, count),
                         .normal = plane("guide_normal", first, count)};
        const std::vector<std::int64_t>& offset = film_.sums.at(half_plane("guide_offset", half_));
        for (std::size_t i = 0; i < rows.reflected.size(); ++i) {
            rows.reflected[i] -= rows.sharp[i];
            rows.normal[i].w = film_mean(offset[pixel(first) + i], samples(first, i));
        }
        return rows;
    }

  private:
    [[nodiscard]] std::size_t pixel(int row) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(film_.width);
    }

    [[nodiscard]] std::uint64_t samples(int first, std::size_t i) const {
        return rows_of(film_,
                       half_)[static_cast<std::size_t>(first) + i / static_cast<std::size_t>(film_.width)];
    }

    [[nodiscard]] std::vector<glm::vec4> plane(const char* name, int first, int count) const {
        const std::vector<std::int64_t>& sums = film_.sums.at(half_plane(name, half_));
        std::vector<glm::vec4> texels(pixel(count));
        for (std::size_t i = 0; i < texels.size(); ++i) {
            for (std::size_t c = 0; c < 3; ++c)
                texels[i][static_cast<glm::length_t>(c)] =
                    film_mean(sums[3 * (pixel(first) + i) + c], samples(first, i));
        }
        return texels;
    }

    const FilmSums& film_;
    std::size_t half_;
};

// Fraction of the samples that the even half has. Where a time limit has left rows with different counts, it
// is that of all rows together: close enough for an error estimate.
float share_of_even(const FilmSums& film) {
    const auto sum = [](const std::vector<std::uint32_t>& rows) {
        return static_cast<double>(std::accumulate(rows.begin(), rows.end(), std::uint64_t{0}));
    };
    const double even = sum(film.even);
    return static_cast<float>(even / (even + sum(film.odd)));
}

// All rows of the results of record_denoise().
struct DenoisedTexels {
    std::vector<glm::vec4> picture, errors;
    std::vector<PassTime> passes;
};

void denoise_strip(const FilmSums& film, const DenoiseStrip& strip, int most_rows, Executor& executor,
                   DenoisedTexels& result) {
    const std::array<DenoiseHalf, 2> halves{HalfReader(film, 0).read(strip.low, strip.rows),
                                            HalfReader(film, 1).read(strip.low, strip.rows)};
    Recording recording;
    const DenoisedBuffers buffers =
        record_denoise({film.width, strip.rows}, most_rows, share_of_even(film), halves, recording);
    const RunResult run = executor.run(recording);
    const auto append = [&](const std::string& buffer, std::vector<glm::vec4>& texels) {
        const std::vector<glm::vec4> all = values_of<glm::vec4>(run, buffer);
        const auto begin = all.begin() + static_cast<std::ptrdiff_t>(strip.first - strip.low) * film.width;
        texels.insert(texels.end(), begin, begin + static_cast<std::ptrdiff_t>(strip.count) * film.width);
    };
    append(buffers.picture, result.picture);
    append(buffers.errors, result.errors);
    add_times(result.passes, run.passes);
}

DenoisedTexels denoise_strips_of(const FilmSums& film, std::size_t strip_pixels, Executor& executor) {
    const std::vector<DenoiseStrip> strips = denoise_strips({film.width, film.height}, strip_pixels);
    DenoisedTexels result;
    for (const DenoiseStrip& strip : strips)
        denoise_strip(film, strip, most_rows(strips), executor, result);
    return result;
}

std::vector<float> component(const std::vector<glm::vec4>& texels, glm::length_t i) {
    std::vector<float> values(texels.size());
    std::ranges::transform(texels, values.begin(), [i](const glm::vec4& texel) { return texel[i]; });
    return values;
}

// Running means along an axis: `count` lines of `length` values, `step` apart.
std::vector<double> line_means(const std::vector<double>& values, std::size_t length, std::size_t step) {
    std::vector<double> means(values.size());
    for (std::size_t begin = 0; begin < values.size(); ++begin) {
        const std::size_t place = begin / step % length;
        const std::size_t before = std::min<std::size_t>(place, kErrorReach);
        const std::size_t after = std::min<std::size_t>(length - 1 - place, kErrorReach);
        double sum = 0.0;
        for (std::size_t i = 0; i <= before + after; ++i)
            sum += values[begin - before * step + i * step];
        means[begin] = sum / static_cast<double>(before + after + 1);
    }
    return means;
}

// RMS error around each pixel: the squared error of a single pixel is mostly noise.
std::vector<float> smoothed_errors(const FilmSums& film, const std::vector<glm::vec4>& errors) {
    std::vector<double> squares(errors.size());
    std::ranges::transform(errors, squares.begin(),
                           [](const glm::vec4& texel) { return static_cast<double>(texel.z); });
    const auto width = static_cast<std::size_t>(film.width), height = static_cast<std::size_t>(film.height);
    squares = line_means(line_means(squares, width, 1), height, width);
    std::vector<float> roots(squares.size());
    std::ranges::transform(squares, roots.begin(), [](double square) {
        return static_cast<float>(std::sqrt(std::max(square, 0.0)));
    });
    return roots;
}

// The halves agree on light that photons smooth, so their difference does not contain that bias.
ErrorEstimate with_photon_bias(ErrorEstimate claim, const FilmSums& film) {
    if (!film.sums.contains("bias_a")) return claim;
    const FilmHalves halves(film);
    return with_bias(std::move(claim), estimate_bias(film.width, film.height, halves.a, halves.b,
                                                     film.sums.at("bias_a"), film.sums.at("bias_b")));
}

}  // namespace

bool has_guides(const FilmSums& film) {
    const std::size_t pixels = static_cast<std::size_t>(film.width) * static_cast<std::size_t>(film.height);
    return std::ranges::all_of(kGuidePlanes, [&](const char* plane) {
        const std::size_t components = std::string_view(plane) == "guide_offset" ? 1 : 3;
        return std::ranges::all_of(std::array{0u, 1u}, [&](std::size_t half) {
            const auto sums = film.sums.find(half_plane(plane, half));
            return sums != film.sums.end() && sums->second.size() == components * pixels;
        });
    });
}

Denoised denoise_film(const FilmSums& film, Executor& executor, std::size_t strip_pixels) {
    VX_ASSERT(has_guides(film));
    Denoised denoised;
    if (std::ranges::min(film.even) == 0 || std::ranges::min(film.odd) == 0) {
        denoised.reason = kNoHalves;
        return denoised;
    }
    const DenoisedTexels texels = denoise_strips_of(film, strip_pixels, executor);
    denoised.passes = texels.passes;
    const std::vector<float> filtered = component(texels.picture, 3), plain = component(texels.errors, 1);
    const auto sum = [](const std::vector<float>& values) {
        return std::accumulate(values.begin(), values.end(), 0.0);
    };
    if (!(sum(filtered) <= sum(plain))) {
        denoised.reason = "the filtered picture is claimed to be worse than the plain one";
        return denoised;
    }
    for (glm::length_t c = 0; c < 3; ++c)
        denoised.rgb[static_cast<std::size_t>(c)] = component(texels.picture, c);
    denoised.error = smoothed_errors(film, texels.errors);
    denoised.claim = with_photon_bias(
        denoised_error(film.width, film.height, filtered, component(texels.errors, 0)), film);
    return denoised;
}

void add_denoised(const Denoised& denoised, Image& image) {
    if (!denoised.is_filtered()) return;
    for (std::size_t c = 0; c < 3; ++c)
        image.channels[std::string("denoised.") + "RGB"[c]] = {Image::Precision::half, denoised.rgb[c]};
    image.channels["denoised.error.Y"] = {Image::Precision::single, denoised.error};
}

Image shown_picture(const Denoised& denoised, const Image& image) {
    Image shown{.width = image.width, .height = image.height};
    for (const char* name : {"R", "G", "B", "A"}) {
        if (const auto channel = image.channels.find(name); channel != image.channels.end())
            shown.channels[name] = channel->second;
    }
    for (std::size_t c = 0; denoised.is_filtered() && c < 3; ++c)
        shown.channels[std::string(1, "RGB"[c])].pixels = denoised.rgb[c];
    return shown;
}

}  // namespace voxilux
