#include "film/film_sums.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "base/assert.h"
#include "base/printable.h"
#include "film/film.h"
#include "formats/exr.h"

namespace voxilux {
namespace {

constexpr std::array<const char*, 3> kXyz{"X", "Y", "Z"};
constexpr std::array<const char*, 3> kRgb{"R", "G", "B"};
constexpr std::size_t kMaxComponents = 4;

std::size_t pixels_of(const FilmSums& film) {
    return static_cast<std::size_t>(film.width) * static_cast<std::size_t>(film.height);
}

// Planes that are summed in two halves. Such a half is not an AOV.
bool is_half(const std::string& plane) {
    return plane.ends_with("_a") || plane.ends_with("_b");
}

std::string channel_of(const std::string& plane, std::size_t component, std::size_t components) {
    if (plane == "normal") return fmt::format("N.{}", kXyz[component]);
    if (plane == "position") return fmt::format("P.{}", kXyz[component]);
    if (plane == "depth") return "Z";
    if (plane == "coverage") return "A";
    return fmt::format("{}.{}", plane, components == 1 ? "Y" : kRgb[component]);
}

std::vector<std::uint64_t> spread_rows(const FilmSums& film, const std::vector<std::uint32_t>& rows) {
    VX_ASSERT_EQ(rows.size(), static_cast<std::size_t>(film.height));
    std::vector<std::uint64_t> counts;
    counts.reserve(pixels_of(film));
    for (const std::uint32_t n : rows)
        counts.insert(counts.end(), static_cast<std::size_t>(film.width), n);
    return counts;
}

void add_means(const FilmSums& film, const std::string& name, Image& image) {
    const std::vector<std::int64_t>& sums = film.sums.at(name);
    const std::size_t components = sums.size() / pixels_of(film);
    const std::size_t row_sums = static_cast<std::size_t>(film.width) * components;
    for (std::size_t i = 0; i < components; ++i) {
        std::vector<float> means;
        means.reserve(pixels_of(film));
        for (std::size_t row = 0; row < film.even.size(); ++row) {
            const auto of_row = std::span(sums).subspan(row * row_sums, row_sums);
            const std::uint64_t count = std::uint64_t{film.even[row]} + film.odd[row];
            const std::vector<float> part = mean_plane(of_row, components, i, count);
            means.insert(means.end(), part.begin(), part.end());
        }
        image.channels[channel_of(name, i, components)] = {Image::Precision::single, std::move(means)};
    }
}

void add_first(const FilmSums& film, const std::string& name, Image& image) {
    const std::vector<float>& values = film.firsts.at(name);
    const std::size_t components = values.size() / pixels_of(film);
    for (std::size_t i = 0; i < components; ++i) {
        std::vector<float> channel(pixels_of(film));
        for (std::size_t pixel = 0; pixel < channel.size(); ++pixel)
            channel[pixel] = values[pixel * components + i];
        image.channels[channel_of(name, i, components)] = {Image::Precision::single, std::move(channel)};
    }
}

// Rows without samples take the positions and depths of the other film.
void add_firsts(FilmSums& film, const FilmSums& more) {
    for (auto& [name, values] : film.firsts) {
        const std::vector<float>& others = more.firsts.at(name);
        VX_ASSERT_EQ(values.size(), others.size());
        const std::size_t row_values = values.size() / film.even.size();
        for (std::size_t row = 0; row < film.even.size(); ++row) {
            if (film.even[row] + film.odd[row] != 0) continue;
            const auto first = static_cast<std::ptrdiff_t>(row * row_values);
            std::copy_n(others.begin() + first, row_values, values.begin() + first);
        }
    }
}

void add_variance(const FilmSums& film, const FilmHalves& halves, Image& image) {
    const std::vector<std::int64_t>& squares = film.sums.at(kSquaresPlane);
    std::array<std::vector<float>, 3> planes;
    for (std::size_t pixel = 0; pixel < pixels_of(film); ++pixel) {
        const std::array<double, 3> variance = mean_variance(halves.a, halves.b, squares, pixel);
        for (std::size_t c = 0; c < 3; ++c)
            planes[c].push_back(static_cast<float>(variance[c]));
    }
    for (std::size_t c = 0; c < 3; ++c)
        image.channels[channel_of("variance", c, 3)] = {Image::Precision::single, std::move(planes[c])};
}

std::int64_t wrapped_sum(std::int64_t a, std::int64_t b) {
    return static_cast<std::int64_t>(static_cast<std::uint64_t>(a) + static_cast<std::uint64_t>(b));
}

// The mean of both halves.
void add_bias(const FilmSums& film, Image& image) {
    FilmSums whole{.width = film.width, .height = film.height, .even = film.even, .odd = film.odd};
    std::vector<std::int64_t>& sums = whole.sums["bias"];
    sums = film.sums.at("bias_a");
    std::ranges::transform(sums, film.sums.at("bias_b"), sums.begin(), wrapped_sum);
    add_means(whole, "bias", image);
}

bool is_aov(const std::string& plane) {
    return !is_half(plane) && plane != kSquaresPlane;
}

// The beauty, its variance and its bias.
Image beauty_of(const FilmSums& film) {
    const FilmHalves halves(film);
    Image image = film_image(film.width, film.height, halves.a, halves.b);
    if (film.sums.contains(kSquaresPlane)) add_variance(film, halves, image);
    if (film.sums.contains("bias_a")) add_bias(film, image);
    return image;
}

// The sum of two numbers that are 0 or above, saturated at kSquaresFull, so that the order does not matter.
std::int64_t full_sum(std::int64_t a, std::int64_t b) {
    const std::int64_t sum = std::max<std::int64_t>(a, 0);
    const std::int64_t more = std::max<std::int64_t>(b, 0);
    return sum > kSquaresFull - more ? kSquaresFull : sum + more;
}

std::string word_plane(const std::string& plane, std::size_t component, const char* half) {
    return fmt::format("{}{}.{}.{}", kSumsLayer, plane, component, half);
}

// How many components of a plane an image has words for.
std::size_t stored_components(const Image& image, const std::string& plane) {
    std::size_t components = 0;
    while (components < kMaxComponents && image.words.contains(word_plane(plane, components, "lo")) &&
           image.words.contains(word_plane(plane, components, "hi")))
        ++components;
    return components;
}

std::vector<std::int64_t> joined_words(const Image& image, const std::string& plane, std::size_t components) {
    std::vector<std::int64_t> sums(pixel_count(image) * components);
    for (std::size_t i = 0; i < components; ++i) {
        const std::vector<std::uint32_t>& low = image.words.at(word_plane(plane, i, "lo"));
        const std::vector<std::uint32_t>& high = image.words.at(word_plane(plane, i, "hi"));
        for (std::size_t pixel = 0; pixel < low.size(); ++pixel)
            sums[pixel * components + i] =
                static_cast<std::int64_t>((std::uint64_t{high[pixel]} << 32) | low[pixel]);
    }
    return sums;
}

void load_first(const Image& image, const std::string& name, std::size_t components, FilmSums& film) {
    std::vector<float> values(pixel_count(image) * components);
    for (std::size_t i = 0; i < components; ++i) {
        const auto found = image.channels.find(channel_of(name, i, components));
        if (found == image.channels.end()) return;
        for (std::size_t pixel = 0; pixel < found->second.pixels.size(); ++pixel)
            values[pixel * components + i] = found->second.pixels[pixel];
    }
    film.firsts[name] = std::move(values);
}

// Why the planes cannot be those of one film; empty when they can. A plane has one component or three, and a
// half has its other half: making images and merging rely on both.
std::string damage_of(const FilmSums& film) {
    for (const auto& [name, sums] : film.sums) {
        const std::size_t components = sums.size() / pixels_of(film);
        if (components != 1 && components != 3)
            return fmt::format("its plane {} is damaged", quoted_name(name));
        if (!is_half(name)) continue;
        const auto other =
            film.sums.find(name.substr(0, name.size() - 1) + (name.ends_with("a") ? "b" : "a"));
        if (other == film.sums.end() || other->second.size() != sums.size())
            return fmt::format("its plane {} lacks the other half", quoted_name(name));
    }
    const auto is_colour = [&](const char* name) {
        const auto plane = film.sums.find(name);
        return plane != film.sums.end() && plane->second.size() == 3 * pixels_of(film);
    };
    if (!is_colour("beauty_a")) return "it has no sums of the beauty";
    for (const char* name : {kSquaresPlane, "bias_a"}) {
        if (film.sums.contains(name) && !is_colour(name)) return fmt::format("its plane {} is damaged", name);
    }
    return "";
}

}  // namespace

FilmHalves::FilmHalves(const FilmSums& film)
    : even(spread_rows(film, film.even)),
      odd(spread_rows(film, film.odd)),
      a{film.sums.at("beauty_a"), even},
      b{film.sums.at("beauty_b"), odd} {}

void add_film(FilmSums& film, const FilmSums& more) {
    VX_ASSERT(film.width == more.width && film.height == more.height);
    VX_ASSERT_EQ(film.sums.size(), more.sums.size());
    add_firsts(film, more);
    add_rows(film, 0, more);
    std::ranges::transform(film.even, more.even, film.even.begin(), std::plus());
    std::ranges::transform(film.odd, more.odd, film.odd.begin(), std::plus());
}

void add_rows(FilmSums& film, std::size_t first, const FilmSums& rows) {
    VX_ASSERT_EQ(film.width, rows.width);
    VX_ASSERT(first + static_cast<std::size_t>(rows.height) <= static_cast<std::size_t>(film.height));
    for (const auto& [name, more] : rows.sums) {
        const std::size_t row_sums = more.size() / static_cast<std::size_t>(rows.height);
        std::vector<std::int64_t>& sums = film.sums[name];
        if (sums.empty()) sums.resize(row_sums * static_cast<std::size_t>(film.height));
        VX_ASSERT_EQ(sums.size(), row_sums * static_cast<std::size_t>(film.height));
        const auto own = std::span(sums).subspan(first * row_sums, more.size());
        std::ranges::transform(own, more, own.begin(), name == kSquaresPlane ? full_sum : wrapped_sum);
    }
}

void set_firsts(FilmSums& film, std::size_t first, const FilmSums& rows) {
    for (const auto& [name, more] : rows.firsts) {
        const std::size_t row_values = more.size() / static_cast<std::size_t>(rows.height);
        std::vector<float>& values = film.firsts[name];
        values.resize(row_values * static_cast<std::size_t>(film.height));
        std::ranges::copy(more, values.begin() + static_cast<std::ptrdiff_t>(first * row_values));
    }
}

Image picture_of(const FilmSums& film) {
    Image image = beauty_of(film);
    for (const auto& [name, sums] : film.sums) {
        if (is_aov(name)) add_means(film, name, image);
    }
    for (const auto& [name, values] : film.firsts)
        add_first(film, name, image);
    return image;
}

Image picture_of(FilmSums&& film) {
    Image aovs;
    for (auto plane = film.sums.begin(); plane != film.sums.end();) {
        if (is_aov(plane->first)) add_means(film, plane->first, aovs);
        plane = is_aov(plane->first) ? film.sums.erase(plane) : std::next(plane);
    }
    for (const auto& [name, values] : film.firsts)
        add_first(film, name, aovs);
    film.firsts.clear();
    Image image = beauty_of(film);
    film.sums.clear();
    image.channels.merge(aovs.channels);
    return image;
}

void store_sums(FilmSums film, Image& image) {
    film.firsts.clear();  // the image has them
    while (!film.sums.empty()) {
        const auto plane = film.sums.extract(film.sums.begin());
        const std::size_t components = plane.mapped().size() / pixels_of(film);
        VX_ASSERT(components <= kMaxComponents);
        for (std::size_t i = 0; i < components; ++i) {
            std::vector<std::uint32_t> low(pixels_of(film)), high(pixels_of(film));
            for (std::size_t pixel = 0; pixel < low.size(); ++pixel) {
                const auto bits = static_cast<std::uint64_t>(plane.mapped()[pixel * components + i]);
                low[pixel] = static_cast<std::uint32_t>(bits);
                high[pixel] = static_cast<std::uint32_t>(bits >> 32);
            }
            image.words[word_plane(plane.key(), i, "lo")] = std::move(low);
            image.words[word_plane(plane.key(), i, "hi")] = std::move(high);
        }
    }
}

Result<FilmSums> load_sums(const Image& image) {
    FilmSums film{.width = image.width, .height = image.height};
    const std::string first_words = ".0.lo";
    for (const auto& [name, words] : image.words) {
        if (!name.starts_with(kSumsLayer) || !name.ends_with(first_words)) continue;
        const std::size_t prefix = std::string_view(kSumsLayer).size();
        const std::string plane = name.substr(prefix, name.size() - prefix - first_words.size());
        const std::size_t components = stored_components(image, plane);
        if (components > 0) film.sums[plane] = joined_words(image, plane, components);
    }
    if (const std::string damage = damage_of(film); !damage.empty()) return Failure{damage};
    load_first(image, "position", 3, film);
    load_first(image, "depth", 1, film);
    return film;
}

}  // namespace voxilux
