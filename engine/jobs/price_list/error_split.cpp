#include "jobs/price_list/error_split.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/assert.h"
#include "estimators/difference_estimate.h"
#include "estimators/metrics.h"

namespace voxilux {
namespace {

double root(double square) {
    return std::sqrt(std::max(square, 0.0));
}

}  // namespace

double relative_square(const Image& picture, const Image& reference) {
    return measure_difference(reference, picture, selected_pixels(reference.width, reference.height, {}))
        .relmse;
}

SplitError split_error(std::span<const Image> pictures, const Image& reference, const ReferenceNoise& noise) {
    std::vector<DifferenceTrial> trials;
    SplitError error;
    double mean = 0.0;
    for (const Image& picture : pictures) {
        trials.push_back({.test = &picture, .base = &reference});
        const double square = relative_square(picture, reference);
        mean += square / static_cast<double>(pictures.size());
        error.squares.push_back(square - noise.square);
    }
    const SquareEstimate common = estimate_difference(trials, &reference);
    error.total = root(mean - noise.square);
    error.noise = root(mean - common.squared);
    error.bias = root(common.squared - noise.square);
    error.bias_low = root(common.low - noise.high);
    error.bias_high = root(common.high - noise.low);
    if (error.bias_low == 0.0 && common.squared < noise.square) error.bias = 0.0;
    error.is_limited = mean - noise.square < kReferenceMargin * kReferenceMargin * noise.square;
    return error;
}

std::uint64_t differing_pixels(const Image& a, const Image& b) {
    const auto x = colour_planes(a), y = colour_planes(b);
    VX_ASSERT(x && y && pixel_count(a) == pixel_count(b));
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < pixel_count(a); ++i) {
        const auto differs = [&](std::size_t c) {
            return std::memcmp(&(*x)[c][i], &(*y)[c][i], sizeof(float)) != 0;
        };
        count += differs(0) || differs(1) || differs(2) ? 1 : 0;
    }
    return count;
}

}  // namespace voxilux
