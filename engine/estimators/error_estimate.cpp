// The two-halves argument. Let A and B be the means of nA and nB independent samples of variance v. Then
// E[(A-B)^2] = v (1/nA + 1/nB), and the mean of all samples has variance v / (nA + nB), so
//     D^2 = (A-B)^2 nA nB / (nA+nB)^2
// estimates the squared error of the mean without bias, whatever the distribution of the samples.
//
// The error of the image is relMSE = mean of D^2 / (r^2 + kRelMseEpsilon) over pixels and channels, r the
// true value. Taking the pixel's own mean m for r fails where it is needed most: a firefly makes D and m
// large together, and the estimate comes out several times too small. So where the halves disagree (|D| over
// a quarter of |m|), r is taken from m and the mean of the 24 pixels around it: the smaller of the two for
// the estimate, the larger for the lower end of the interval. Where they agree, and so everywhere in the end,
// m itself is used.
//
// The interval comes from square blocks of pixels, which keep it honest when neighbours are correlated.
// Blocks differ by noise and by what they show; differences between neighbouring blocks cancel most of the
// latter and what is left errs on the wide side (J. von Neumann et al., "The mean square successive
// difference", 1941). The true relMSE scatters about its expectation as much as the estimate does and
// independently of it (A+B and A-B are uncorrelated), hence the factor 2. The interval is laid on
// log(relMSE), which is nearer to normal and cannot turn negative; Student's t allows for the finite
// number of blocks.
//
// Where samples are independent and their squares were summed, too, the unbiased variance of all samples
// stands in for D^2, with n - 1 degrees of freedom instead of one. The estimate then scatters less than the
// truth does, so that the two variances of blocks are no longer one: that of the truth is still measured on
// D^2, which is distributed as the squared error is.

#include "estimators/error_estimate.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/assert.h"
#include "base/statistics.h"
#include "estimators/metrics.h"

namespace voxilux {
namespace {

constexpr double kAgreement =
    0.25;                  // |D| / |m| up to which m is trusted: it is then off by a third at the very most
constexpr int kReach = 2;  // pixels: the neighbourhood is 5x5
constexpr int kLargestBlock = 8;                     // pixels a side
constexpr std::size_t kManyBlocks = 32;              // blocks shrink until there are so many
constexpr std::size_t kMinBlocks = 8;                // below, a variance of blocks means nothing
constexpr double kDegreesPerDifference = 2.0 / 3.0;  // successive differences share a block

using Rgb = std::array<double, 3>;

// The means of the rows around the current one; rows outside the image are empty.
class RowWindow {
  public:
    RowWindow(int width, int height, const FilmHalf& a, const FilmHalf& b)
        : width_(width), height_(height), a_(a), b_(b), rows_(2 * kReach + 1) {
        for (int y = 0; y < kReach; ++y)
            load(y);
    }

    // Makes `y` the current row; rows must come in order from 0.
    void advance(int y) { load(y + kReach); }

    // Mean over the pixels around (x, y) without it; the pixel's own where it is alone.
    [[nodiscard]] Rgb neighbourhood(int x, int y) const {
        Rgb sum = {};
        const int x0 = std::max(x - kReach, 0), x1 = std::min(x + kReach, width_ - 1);
        const int y0 = std::max(y - kReach, 0), y1 = std::min(y + kReach, height_ - 1);
        for (int j = y0; j <= y1; ++j) {
            const std::vector<Rgb>& row = row_of(j);
            for (int i = x0; i <= x1; ++i) {
                for (std::size_t c = 0; c < 3; ++c)
                    sum[c] += row[static_cast<std::size_t>(i)][c];
            }
        }
        const Rgb& own = row_of(y)[static_cast<std::size_t>(x)];
        const int others = (x1 - x0 + 1) * (y1 - y0 + 1) - 1;
        if (others == 0) return own;
        for (std::size_t c = 0; c < 3; ++c)
            sum[c] = (sum[c] - own[c]) / others;
        return sum;
    }

  private:
    [[nodiscard]] const std::vector<Rgb>& row_of(int y) const {
        return rows_[static_cast<std::size_t>(y) % rows_.size()];
    }

    void load(int y) {
        if (y >= height_) return;
        std::vector<Rgb>& row = rows_[static_cast<std::size_t>(y) % rows_.size()];
        row.resize(static_cast<std::size_t>(width_));
        const std::size_t first = static_cast<std::size_t>(y) * row.size();
        for (std::size_t x = 0; x < row.size(); ++x)
            row[x] = half_means(a_, b_, first + x).mean;
    }

    int width_, height_;
    const FilmHalf &a_, &b_;
    std::vector<std::vector<Rgb>> rows_;
};

// A pixel's share of relMSE with the cautious and with the hopeful choice of the true value. `drawn` is the
// cautious share that the halves give: a draw from the distribution of the true share.
struct RelativeError {
    double cautious = 0.0, hopeful = 0.0, drawn = 0.0;
};

// Estimates of the squared error by component.
Rgb squared_differences(const HalfMeans& pixel) {
    Rgb result;
    for (std::size_t c = 0; c < 3; ++c) {
        const double d = (pixel.a[c] - pixel.b[c]) * pixel.weight;
        result[c] = d * d;
    }
    return result;
}

// What a known variance adds to the denominator m^2 + kRelMseEpsilon, so that the share is that of the true
// value to second order: noise in m makes 1 / (m^2 + kRelMseEpsilon) too large on average (delta method).
double denominator_bias(double mean, double variance) {
    const double square = mean * mean;
    return variance * (3.0 * square - kRelMseEpsilon) / (square + kRelMseEpsilon);
}

RelativeError relative_error(const HalfMeans& pixel, const Rgb& variance, const Rgb& around, bool is_known) {
    RelativeError error;
    const Rgb drawn = squared_differences(pixel);
    for (std::size_t c = 0; c < 3; ++c) {
        const double own = std::abs(pixel.mean[c]), other = std::abs(around[c]);
        const bool is_trusted = std::sqrt(variance[c]) <= kAgreement * own;
        const double least = is_trusted ? own : std::min(own, other);
        const double most = is_trusted ? own : std::max(own, other);
        const double bias = is_known && is_trusted ? denominator_bias(own, variance[c]) : 0.0;
        error.cautious += variance[c] / (least * least + kRelMseEpsilon + bias) / 3.0;
        error.hopeful += variance[c] / (most * most + kRelMseEpsilon + bias) / 3.0;
        error.drawn += drawn[c] / (least * least + kRelMseEpsilon + bias) / 3.0;
    }
    return error;
}

struct Block {
    CompensatedSum error;
    CompensatedSum drawn;
    double pixels = 0.0;
};

// Square blocks in rows of `across`, and the sums over all of them.
struct Blocks {
    int side = 1;
    std::size_t across = 0;
    std::vector<Block> blocks;
    CompensatedSum cautious, hopeful, drawn;
    bool is_complete = true;  // every pixel has samples in both halves
};

std::size_t blocks_along(int size, int side) {
    return static_cast<std::size_t>((size + side - 1) / side);
}

Blocks make_blocks(int width, int height) {
    int side = kLargestBlock;
    while (side > 1 && blocks_along(width, side) * blocks_along(height, side) < kManyBlocks)
        side /= 2;
    Blocks result{.side = side, .across = blocks_along(width, side)};
    result.blocks.resize(result.across * blocks_along(height, side));
    return result;
}

Blocks gather(int width, int height, const FilmHalf& a, const FilmHalf& b, FilmSquares squares) {
    Blocks result = make_blocks(width, height);
    RowWindow window(width, height, a, b);
    for (int y = 0; y < height; ++y) {
        window.advance(y);
        for (int x = 0; x < width; ++x) {
            const std::size_t pixel =
                static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
            const HalfMeans means = half_means(a, b, pixel);
            result.is_complete = result.is_complete && means.weight > 0.0;
            const Rgb variance =
                squares.empty() ? squared_differences(means) : mean_variance(a, b, squares, pixel);
            const RelativeError error =
                relative_error(means, variance, window.neighbourhood(x, y), !squares.empty());
            Block& block = result.blocks[static_cast<std::size_t>(y / result.side) * result.across +
                                         static_cast<std::size_t>(x / result.side)];
            block.error.add(error.cautious);
            block.drawn.add(error.drawn);
            block.pixels += 1.0;
            result.cautious.add(error.cautious);
            result.hopeful.add(error.hopeful);
            result.drawn.add(error.drawn);
        }
    }
    return result;
}

// Variance of the mean of what the blocks hold. Blocks are walked back and forth, so that successive ones are
// neighbours.
double variance_of_mean(const Blocks& all, CompensatedSum Block::*held, double mean, double pixels) {
    CompensatedSum squares;
    double last = 0.0;
    for (std::size_t k = 0; k < all.blocks.size(); ++k) {
        const std::size_t row = k / all.across, column = k % all.across;
        const Block& block = all.blocks[row * all.across + (row % 2 == 0 ? column : all.across - 1 - column)];
        const double deviation = (block.*held).value() - mean * block.pixels;
        if (k > 0) squares.add((deviation - last) * (deviation - last));
        last = deviation;
    }
    const double count = static_cast<double>(all.blocks.size());
    return 0.5 * squares.value() * count / (count - 1.0) / (pixels * pixels);
}

// Half width of the interval of log(relMSE), or infinity with too few blocks.
double log_spread(const Blocks& all, double pixels) {
    if (all.blocks.size() < kMinBlocks) return std::numeric_limits<double>::infinity();
    const double mean = all.cautious.value() / pixels;
    const double of_estimate = variance_of_mean(all, &Block::error, mean, pixels);
    const double of_truth = variance_of_mean(all, &Block::drawn, all.drawn.value() / pixels, pixels);
    const double count = static_cast<double>(all.blocks.size());
    return student_quantile(kClaimQuantile, kDegreesPerDifference * (count - 1.0)) *
           std::sqrt(of_estimate + of_truth) / mean;
}

}  // namespace

ErrorEstimate unknown_error() {
    constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
    return {.estimate = kNaN, .low = kNaN, .high = std::numeric_limits<double>::infinity()};
}

ErrorEstimate estimate_error(int width, int height, const FilmHalf& a, const FilmHalf& b,
                             FilmSquares squares) {
    const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    check_half(a, pixels);
    check_half(b, pixels);
    const double infinity = std::numeric_limits<double>::infinity();
    VX_ASSERT(squares.empty() || squares.size() == 3 * pixels);
    const Blocks blocks = gather(width, height, a, b, squares);
    if (!blocks.is_complete) return {.estimate = infinity, .high = infinity};
    const double count = static_cast<double>(pixels);
    const double cautious = blocks.cautious.value() / count, hopeful = blocks.hopeful.value() / count;
    if (!(cautious > 0.0)) return {};
    const double spread = std::exp(0.5 * log_spread(blocks, count));
    return {.estimate = std::sqrt(cautious),
            .low = std::sqrt(hopeful) / spread,
            .high = std::sqrt(cautious) * spread};
}

}  // namespace voxilux
