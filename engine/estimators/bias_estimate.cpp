#include "estimators/bias_estimate.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/statistics.h"
#include "estimators/metrics.h"

namespace voxilux {
namespace {

double square_of_pixel(const HalfMeans& beauty, const HalfMeans& bias) {
    double total = 0.0;
    for (std::size_t c = 0; c < 3; ++c)
        total += bias.a[c] * bias.b[c] / (beauty.mean[c] * beauty.mean[c] + kRelMseEpsilon);
    return total / 3.0;
}

}  // namespace

double BiasEstimate::max_squared() const {
    return std::max(squared + kOneSided95 * deviation, 0.0);
}

BiasEstimate estimate_bias(int width, int height, const FilmHalf& beauty_a, const FilmHalf& beauty_b,
                           std::span<const std::int64_t> bias_a, std::span<const std::int64_t> bias_b) {
    const FilmHalf a{bias_a, beauty_a.samples}, b{bias_b, beauty_b.samples};
    const int across = (width + kBlockEdge - 1) / kBlockEdge;
    const int down = (height + kBlockEdge - 1) / kBlockEdge;
    std::vector<double> blocks(static_cast<std::size_t>(across) * static_cast<std::size_t>(down), 0.0);
    double sum = 0.0;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const std::size_t pixel =
                static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
            const double square =
                square_of_pixel(half_means(beauty_a, beauty_b, pixel), half_means(a, b, pixel));
            blocks[static_cast<std::size_t>(y / kBlockEdge * across + x / kBlockEdge)] += square;
            sum += square;
        }
    }
    const double pixels = static_cast<double>(width) * static_cast<double>(height);
    const double count = static_cast<double>(blocks.size());
    double scatter = 0.0;
    for (const double block : blocks)
        scatter += (block - sum / count) * (block - sum / count);
    const double variance = count > 1.0 ? scatter * count / (count - 1.0) : sum * sum;
    return {.squared = sum / pixels, .deviation = std::sqrt(variance) / pixels};
}

ErrorEstimate with_bias(ErrorEstimate noise, const BiasEstimate& bias) {
    ErrorEstimate total = noise;
    const double likely = std::max(bias.squared, 0.0);
    const double least = std::max(bias.squared - kOneSided95 * bias.deviation, 0.0);
    total.noise = noise.estimate;
    total.bias = std::sqrt(likely);
    total.estimate = std::sqrt(noise.estimate * noise.estimate + likely);
    total.low = std::sqrt(noise.low * noise.low + least);
    total.high = std::sqrt(noise.high * noise.high + bias.max_squared());
    total.bias_squared = bias;
    return total;
}

}  // namespace voxilux
