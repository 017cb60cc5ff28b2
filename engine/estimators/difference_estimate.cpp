// The product of two independent measurements of a difference has the square of the true difference as its
// mean, whatever the noise: the square of one measurement would hold the noise's variance, too. All pairs of
// trials are averaged, a U-statistic (W. Hoeffding, "A class of statistics with asymptotically normal
// distribution", 1948), and divided by a radiance that neither of the two measured, so that noise in it
// cannot agree with theirs.
//
// The interval comes from the jackknife over trials (B. Efron and C. Stein, "The jackknife estimate of
// variance", 1981: never too narrow on average), in square blocks of pixels: the blocks add degrees of
// freedom and keep correlated pixels together. Blocks may differ in what they show without widening the
// interval, so that a small bright spot is told from noise.

#include "estimators/difference_estimate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "base/assert.h"
#include "base/statistics.h"
#include "estimators/bias_estimate.h"
#include "estimators/metrics.h"

namespace voxilux {
namespace {

using Planes = std::array<std::span<const float>, 3>;
using Pair = std::pair<std::size_t, std::size_t>;

Planes planes_of(const Image& image) {
    const auto planes = colour_planes(image);
    VX_ASSERT(planes.has_value());
    return *planes;
}

std::vector<Pair> pairs_of(std::size_t trials) {
    std::vector<Pair> pairs;
    for (std::size_t a = 0; a < trials; ++a)
        for (std::size_t b = a + 1; b < trials; ++b)
            pairs.emplace_back(a, b);
    return pairs;
}

struct Trials {
    std::vector<Planes> tests, bases;
    std::optional<Planes> radiance;

    // The radiance to divide by: that given, or the mean of the bases that are not in the pair.
    [[nodiscard]] double scale(const Pair& pair, std::size_t c, std::size_t pixel) const {
        if (radiance) return static_cast<double>((*radiance)[c][pixel]);
        double sum = 0.0;
        for (std::size_t k = 0; k < bases.size(); ++k)
            if (k != pair.first && k != pair.second) sum += static_cast<double>(bases[k][c][pixel]);
        return sum / static_cast<double>(bases.size() - 2);
    }
    [[nodiscard]] double difference(std::size_t k, std::size_t c, std::size_t pixel) const {
        return static_cast<double>(tests[k][c][pixel]) - static_cast<double>(bases[k][c][pixel]);
    }
    // Each component is clamped to `most` in either direction, so that a mean of 0 stays 0.
    [[nodiscard]] double product(const Pair& pair, std::size_t pixel, double most) const {
        double sum = 0.0;
        for (std::size_t c = 0; c < 3; ++c) {
            const double both = difference(pair.first, c, pixel) * difference(pair.second, c, pixel);
            const double r = scale(pair, c, pixel);
            if (both != 0.0) sum += std::clamp(both / (r * r + kRelMseEpsilon), -most, most);
        }
        return sum / 3.0;
    }
};

// The jackknife variance of the mean over pairs of a block's sums.
double variance_of_block(std::span<const double> sums, std::span<const Pair> pairs, std::size_t trials) {
    std::vector<double> without(trials, 0.0);
    for (std::size_t p = 0; p < pairs.size(); ++p)
        for (std::size_t k = 0; k < trials; ++k)
            if (k != pairs[p].first && k != pairs[p].second) without[k] += sums[p];
    const double n = static_cast<double>(trials);
    const double left = (n - 1.0) * (n - 2.0) / 2.0;  // pairs without one trial
    double mean = 0.0, scatter = 0.0;
    for (double& value : without)
        mean += (value /= left) / n;
    for (const double value : without)
        scatter += (value - mean) * (value - mean);
    return scatter * (n - 1.0) / n;
}

// Sums of products, [block][pair].
std::vector<double> block_sums(const Trials& trials, std::span<const Pair> pairs, glm::ivec2 size,
                               double most) {
    const auto [width, height] = std::pair(size.x, size.y);
    const int across = (width + kBlockEdge - 1) / kBlockEdge;
    const int down = (height + kBlockEdge - 1) / kBlockEdge;
    std::vector<double> sums(static_cast<std::size_t>(across * down) * pairs.size(), 0.0);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const std::size_t pixel =
                static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
            const auto block = static_cast<std::size_t>(y / kBlockEdge * across + x / kBlockEdge);
            for (std::size_t p = 0; p < pairs.size(); ++p)
                sums[block * pairs.size() + p] += trials.product(pairs[p], pixel, most);
        }
    }
    return sums;
}

SquareEstimate from_blocks(const std::vector<double>& sums, std::span<const Pair> pairs, std::size_t trials,
                           double pixels) {
    CompensatedSum total;
    double variance = 0.0;
    for (std::size_t i = 0; i < sums.size(); i += pairs.size()) {
        const auto of_block = std::span(sums).subspan(i, pairs.size());
        for (const double sum : of_block)
            total.add(sum / static_cast<double>(pairs.size()));
        variance += variance_of_block(of_block, pairs, trials);
    }
    const double degrees = static_cast<double>((trials - 1) * (sums.size() / pairs.size()));
    const double spread = student_quantile_95(degrees) * std::sqrt(variance) / pixels;
    const double squared = total.value() / pixels;
    return {.squared = squared, .low = squared - spread, .high = squared + spread};
}

}  // namespace

SquareEstimate estimate_difference(std::span<const DifferenceTrial> trials, const Image* radiance) {
    VX_ASSERT(trials.size() >= kMinTrials);
    Trials all;
    const Image& first = *trials.front().test;
    for (const DifferenceTrial& trial : trials) {
        VX_ASSERT(trial.test->width == first.width && trial.test->height == first.height);
        VX_ASSERT(trial.base->width == first.width && trial.base->height == first.height);
        all.tests.push_back(planes_of(*trial.test));
        all.bases.push_back(planes_of(*trial.base));
    }
    if (radiance != nullptr) all.radiance = planes_of(*radiance);
    const std::vector<Pair> pairs = pairs_of(trials.size());
    const auto estimate = [&](double most) {
        return from_blocks(block_sums(all, pairs, {first.width, first.height}, most), pairs, trials.size(),
                           static_cast<double>(pixel_count(first)));
    };
    SquareEstimate result = estimate(std::numeric_limits<double>::infinity());
    result.bounded_low = estimate(1.0).low;
    return result;
}

}  // namespace voxilux
