#include "film/film.h"

#include <algorithm>
#include <cmath>

#include "base/assert.h"
#include "base/colour.h"

namespace voxilux {
namespace {

std::uint64_t samples_of(const FilmHalf& half, std::size_t pixel) {
    return half.samples.size() == 1 ? half.samples[0] : half.samples[pixel];
}

// 0 when there are no samples. In long double a sum of 63 bits is exact and the quotient has 11 bits more
// than a double, so that rounding twice does no harm.
long double mean_of(long double sum, std::uint64_t count) {
    return count > 0 ? std::ldexp(sum / static_cast<long double>(count), -kFilmFractionBits) : 0.0L;
}

}  // namespace

float film_mean(std::int64_t sum, std::uint64_t count) {
    return static_cast<float>(mean_of(static_cast<long double>(sum), count));
}

HalfMeans half_means(const FilmHalf& a, const FilmHalf& b, std::size_t pixel) {
    const std::uint64_t na = samples_of(a, pixel), nb = samples_of(b, pixel);
    HalfMeans result;
    for (std::size_t c = 0; c < 3; ++c) {
        const long double sum_a = static_cast<long double>(a.rgb[3 * pixel + c]);
        const long double sum_b = static_cast<long double>(b.rgb[3 * pixel + c]);
        result.a[c] = static_cast<double>(mean_of(sum_a, na));
        result.b[c] = static_cast<double>(mean_of(sum_b, nb));
        result.mean[c] = static_cast<double>(mean_of(sum_a + sum_b, na + nb));
    }
    const double x = static_cast<double>(na), y = static_cast<double>(nb);
    if (na > 0 && nb > 0) result.weight = std::sqrt(x) * std::sqrt(y) / (x + y);
    return result;
}

std::array<double, 3> mean_variance(const FilmHalf& a, const FilmHalf& b, FilmSquares squares,
                                    std::size_t pixel) {
    const std::uint64_t samples = samples_of(a, pixel) + samples_of(b, pixel);
    const HalfMeans means = half_means(a, b, pixel);
    std::array<double, 3> variance{};
    for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t at = 3 * pixel + c;
        const long double sum = static_cast<long double>(a.rgb[at]) + static_cast<long double>(b.rgb[at]);
        const long double mean = mean_of(sum, samples);
        const long double excess = mean_of(static_cast<long double>(squares[at]), samples) - mean * mean;
        const double difference = (means.a[c] - means.b[c]) * means.weight;
        if (samples < 2)
            variance[c] = static_cast<double>(mean * mean);
        else if (squares[at] == kSquaresFull)
            variance[c] = difference * difference;
        else
            variance[c] = static_cast<double>(std::max(excess, 0.0L) / static_cast<long double>(samples - 1));
    }
    return variance;
}

void check_half(const FilmHalf& half, std::size_t pixels) {
    VX_ASSERT_EQ(half.rgb.size(), 3 * pixels);
    VX_ASSERT(half.samples.size() == 1 || half.samples.size() == pixels);
}

std::vector<float> mean_plane(std::span<const std::int64_t> sums, std::size_t stride, std::size_t offset,
                              std::uint64_t count) {
    VX_ASSERT(stride > offset && sums.size() % stride == 0);
    std::vector<float> plane(sums.size() / stride);
    for (std::size_t i = 0; i < plane.size(); ++i)
        plane[i] = film_mean(sums[i * stride + offset], count);
    return plane;
}

Image film_image(int width, int height, const FilmHalf& a, const FilmHalf& b) {
    const std::array<std::string, 5> names = {"R", "G", "B", "error.Y", "sampleCount.Y"};
    Image image = make_image(width, height, names);
    check_half(a, pixel_count(image));
    check_half(b, pixel_count(image));
    std::array<float*, 5> planes;
    for (std::size_t c = 0; c < names.size(); ++c) {
        Image::Channel& channel = image.channels[names[c]];
        channel.precision = c < 3 ? Image::Precision::half : Image::Precision::single;
        planes[c] = channel.pixels.data();
    }
    for (std::size_t i = 0; i < pixel_count(image); ++i) {
        const HalfMeans pixel = half_means(a, b, i);
        for (std::size_t c = 0; c < 3; ++c)
            planes[c][i] = static_cast<float>(pixel.mean[c]);
        const double difference = luminance(pixel.a) - luminance(pixel.b);
        const double error = pixel.weight > 0.0 ? difference * pixel.weight : luminance(pixel.mean);
        planes[3][i] = static_cast<float>(std::abs(error));
        planes[4][i] = static_cast<float>(samples_of(a, i) + samples_of(b, i));
    }
    return image;
}

}  // namespace voxilux
