// The two-halves argument. Let A and B be the means of nA and nB independent samples of variance v. Then
// E[(A-B)^2] = v (1/nA + 1/nB), and the mean of all samples has variance v / (nA + nB), so
//     D^2 = (A-B)^2 nA nB / (nA+nB)^2
// estimates the squared error of the mean without bias, whatever the distribution of the samples.
//
// The error of the picture is relMSE = mean over pixels and channels of D^2 / (mean^2 + kRelMseEpsilon). Its
// interval comes from square blocks of pixels: block sums scatter for two reasons, noise and differences
// between the parts of the picture; taking all of the scatter as noise errs on the wide side, and blocks keep
// it honest when neighbours are correlated. The true relMSE scatters about its expectation as much as the
// estimate does and independently of it (A+B and A-B are uncorrelated), hence the factor 2. The interval is
// laid on log(relMSE), which is nearer to normal and cannot turn negative; Student's t stands for the number
// of blocks being finite.

#include "film/film.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/assert.h"
#include "film/metrics.h"
#include "film/sum.h"

namespace voxilux {
namespace {

constexpr double kFilmScale = static_cast<double>(std::int64_t{1} << kFilmFractionBits);
constexpr double kFilmLimit = static_cast<double>(std::int64_t{1} << 39);
constexpr int kLargestBlock = 8;          // pixels a side: wider than the reach of the pixel filters
constexpr std::size_t kManyBlocks = 32;   // blocks shrink until there are so many
constexpr std::size_t kFewestBlocks = 8;  // below, a variance of blocks means nothing
constexpr double kNormalQuantile = 1.959963984540054;  // two-sided, at kErrorConfidence

std::uint64_t samples_of(const FilmHalf& half, std::size_t pixel) {
    return half.samples.size() == 1 ? half.samples[0] : half.samples[pixel];
}

double luminance(const double rgb[3]) {
    return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];  // Rec.709
}

void check_half(const FilmHalf& half, std::size_t pixels) {
    VX_ASSERT_EQ(half.rgb.size(), 3 * pixels);
    VX_ASSERT(half.samples.size() == 1 || half.samples.size() == pixels);
}

// A sum and its count as they are needed for the mean: exact while long double holds 64 bits.
long double mean_of(long double sum, std::uint64_t count) {
    return sum / (static_cast<long double>(count) * static_cast<long double>(kFilmScale));
}

// One pixel of the two halves.
struct HalfMeans {
    double a[3], b[3], mean[3];
    double weight = 0.0;  // sqrt(nA nB) / (nA + nB), or 0 when a half is empty
};

HalfMeans half_means(const FilmHalf& a, const FilmHalf& b, std::size_t pixel) {
    const std::uint64_t na = samples_of(a, pixel), nb = samples_of(b, pixel);
    HalfMeans result{};
    for (std::size_t c = 0; c < 3; ++c) {
        const long double sum_a = static_cast<long double>(a.rgb[3 * pixel + c]);
        const long double sum_b = static_cast<long double>(b.rgb[3 * pixel + c]);
        result.a[c] = na > 0 ? static_cast<double>(mean_of(sum_a, na)) : 0.0;
        result.b[c] = nb > 0 ? static_cast<double>(mean_of(sum_b, nb)) : 0.0;
        result.mean[c] = na + nb > 0 ? static_cast<double>(mean_of(sum_a + sum_b, na + nb)) : 0.0;
    }
    const double x = static_cast<double>(na), y = static_cast<double>(nb);
    if (na > 0 && nb > 0) result.weight = std::sqrt(x) * std::sqrt(y) / (x + y);
    return result;
}

// The pixel's share of relMSE.
double relative_error(const HalfMeans& pixel) {
    double sum = 0.0;
    for (std::size_t c = 0; c < 3; ++c) {
        const double d = (pixel.a[c] - pixel.b[c]) * pixel.weight;
        sum += d * d / (pixel.mean[c] * pixel.mean[c] + kRelMseEpsilon);
    }
    return sum / 3.0;
}

struct Block {
    CompensatedSum error;
    double pixels = 0.0;
};

std::size_t blocks_along(int size, int side) {
    return static_cast<std::size_t>((size + side - 1) / side);
}

int block_side(int width, int height) {
    int side = kLargestBlock;
    while (side > 1 && blocks_along(width, side) * blocks_along(height, side) < kManyBlocks)
        side /= 2;
    return side;
}

// Student's t from the normal quantile (Abramowitz and Stegun 26.7.5, three terms): within 0.1 % from 7
// degrees on.
double student_quantile(double degrees) {
    const double z = kNormalQuantile;
    const double z3 = z * z * z, z5 = z3 * z * z, z7 = z5 * z * z;
    return z + (z3 + z) / (4.0 * degrees) + (5.0 * z5 + 16.0 * z3 + 3.0 * z) / (96.0 * degrees * degrees) +
           (3.0 * z7 + 19.0 * z5 + 17.0 * z3 - 15.0 * z) / (384.0 * degrees * degrees * degrees);
}

// Standard error of log(relMSE - estimated relMSE), or infinity with too few blocks.
double log_spread(const std::vector<Block>& blocks, double mean, double pixels) {
    if (blocks.size() < kFewestBlocks) return std::numeric_limits<double>::infinity();
    CompensatedSum squares;
    for (const Block& block : blocks) {
        const double deviation = block.error.value() - mean * block.pixels;
        squares.add(deviation * deviation);
    }
    const double count = static_cast<double>(blocks.size());
    const double variance = squares.value() * count / (count - 1.0) / (pixels * pixels);
    return student_quantile(count - 1.0) * std::sqrt(2.0 * variance) / mean;
}

}  // namespace

std::int64_t to_film_fixed(double value) {
    VX_ASSERT(std::abs(value) < kFilmLimit);
    return std::llround(value * kFilmScale);
}

float film_mean(std::int64_t sum, std::uint64_t count) {
    return count > 0 ? static_cast<float>(mean_of(static_cast<long double>(sum), count)) : 0.0f;
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

ErrorEstimate estimate_error(int width, int height, const FilmHalf& a, const FilmHalf& b) {
    const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    check_half(a, pixels);
    check_half(b, pixels);
    const double infinity = std::numeric_limits<double>::infinity();
    const int side = block_side(width, height);
    const std::size_t across = blocks_along(width, side);
    std::vector<Block> blocks(across * blocks_along(height, side));
    CompensatedSum total;
    for (std::size_t i = 0; i < pixels; ++i) {
        const HalfMeans pixel = half_means(a, b, i);
        if (!(pixel.weight > 0.0)) return {.estimate = infinity, .high = infinity};
        const std::size_t x = i % static_cast<std::size_t>(width), y = i / static_cast<std::size_t>(width);
        Block& block =
            blocks[y / static_cast<std::size_t>(side) * across + x / static_cast<std::size_t>(side)];
        const double error = relative_error(pixel);
        block.error.add(error);
        block.pixels += 1.0;
        total.add(error);
    }
    const double mean = total.value() / static_cast<double>(pixels);
    if (!(mean > 0.0)) return {};
    const double spread = std::exp(0.5 * log_spread(blocks, mean, static_cast<double>(pixels)));
    return {.estimate = std::sqrt(mean), .low = std::sqrt(mean) / spread, .high = std::sqrt(mean) * spread};
}

}  // namespace voxilux
