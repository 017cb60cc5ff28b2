#include "estimators/denoised_error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/assert.h"
#include "base/statistics.h"

namespace voxilux {
namespace {

constexpr int kClaimBlock = 8;  // pixels a side
constexpr std::size_t kFewBlocks = 8;

struct MeanOfBlocks {
    double mean = 0.0;
    double deviation = std::numeric_limits<double>::infinity();  // of the mean, times its quantile
};

std::vector<double> block_sums(int width, int height, std::span<const float> values) {
    const int across = (width + kClaimBlock - 1) / kClaimBlock;
    const int down = (height + kClaimBlock - 1) / kClaimBlock;
    std::vector<double> sums(static_cast<std::size_t>(across) * static_cast<std::size_t>(down));
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const int pixel = y * width + x, block = y / kClaimBlock * across + x / kClaimBlock;
            sums[static_cast<std::size_t>(block)] +=
                static_cast<double>(values[static_cast<std::size_t>(pixel)]);
        }
    }
    return sums;
}

// Blocks differ by what they show, too, so intervals are rather too wide than too narrow.
MeanOfBlocks mean_of_blocks(int width, int height, std::span<const float> values) {
    const std::vector<double> sums = block_sums(width, height, values);
    const double count = static_cast<double>(sums.size()), pixels = static_cast<double>(values.size());
    CompensatedSum all, squares;
    for (const double sum : sums)
        all.add(sum);
    MeanOfBlocks result{.mean = all.value() / pixels};
    if (sums.size() < kFewBlocks) return result;
    for (const double sum : sums)
        squares.add((sum - all.value() / count) * (sum - all.value() / count));
    const double of_mean = std::sqrt(squares.value() * count / (count - 1.0)) / pixels;
    result.deviation = student_quantile(kClaimQuantile, count - 1.0) * of_mean;
    return result;
}

}  // namespace

ErrorEstimate denoised_error(int width, int height, std::span<const float> relmse,
                             std::span<const float> variance) {
    VX_ASSERT_EQ(relmse.size(), static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    VX_ASSERT_EQ(relmse.size(), variance.size());
    const MeanOfBlocks all = mean_of_blocks(width, height, relmse);
    const MeanOfBlocks least = mean_of_blocks(width, height, variance);
    const double high = std::max(all.mean + all.deviation, least.mean + least.deviation);
    return {.estimate = std::sqrt(std::max({all.mean, least.mean, 0.0})),
            .low = std::sqrt(std::max(all.mean - all.deviation, 0.0)),
            .high = std::sqrt(std::max(high, 0.0))};
}

}  // namespace voxilux
