// The systematic part of the error from two noisy halves, against biases that are known.

#include "estimators/bias_estimate.h"

#include <cmath>

#include <gtest/gtest.h>

#include "estimators/error_estimate.h"
#include "estimators/metrics.h"
#include "support/statistics.h"

namespace voxilux {
namespace {

constexpr int kBiasWidth = 96, kBiasHeight = 64;
constexpr std::size_t kPixels = std::size_t{kBiasWidth} * kBiasHeight;
constexpr double kRadiance = 0.5;
constexpr std::uint64_t kSamples = 32;  // of each half
constexpr double kUnit = 1 << kFilmFractionBits;

struct Film {
    std::vector<std::int64_t> beauty_a, beauty_b, bias_a, bias_b;
    std::vector<std::uint64_t> samples{kSamples};

    [[nodiscard]] BiasEstimate estimate() const {
        return estimate_bias(kBiasWidth, kBiasHeight, {beauty_a, samples}, {beauty_b, samples}, bias_a,
                             bias_b);
    }
};

std::int64_t sum_of(double mean) {
    return std::llround(mean * static_cast<double>(kSamples) * kUnit);
}

// Grey pixels of one radiance; each half shows `bias`, and its mean has a noise of +-`noise`.
Film film_with(double bias, double noise, std::uint64_t seed) {
    test::TestRandom random(seed);
    Film film;
    for (std::size_t i = 0; i < 3 * kPixels; ++i) {
        film.beauty_a.push_back(sum_of(kRadiance));
        film.beauty_b.push_back(sum_of(kRadiance));
        film.bias_a.push_back(sum_of(bias + random.uniform(-noise, noise)));
        film.bias_b.push_back(sum_of(bias + random.uniform(-noise, noise)));
    }
    return film;
}

double relative_square(double bias) {
    return bias * bias / (kRadiance * kRadiance + kRelMseEpsilon);
}

TEST(BiasEstimate, known_bias_is_found_under_ten_times_its_noise) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const BiasEstimate found = film_with(0.02, 0.2, seed).estimate();
        EXPECT_NEAR(found.squared, relative_square(0.02), 5.0 * found.deviation) << seed;
        EXPECT_LT(found.deviation, 0.35 * relative_square(0.02)) << seed;
    }
}

TEST(BiasEstimate, noise_alone_is_no_bias) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const BiasEstimate found = film_with(0.0, 0.2, seed).estimate();
        EXPECT_LT(std::abs(found.squared), 5.0 * found.deviation) << seed;
    }
}

// Negative control: halves that share their noise mistake it for bias.
TEST(BiasEstimate, halves_that_are_one_are_caught) {
    Film film = film_with(0.0, 0.2, 1);
    film.bias_b = film.bias_a;
    const BiasEstimate found = film.estimate();
    EXPECT_GT(found.squared, 5.0 * found.deviation);
}

TEST(BiasEstimate, deviation_is_that_of_many_trials) {
    double sum = 0.0, squares = 0.0, told = 0.0;
    constexpr int kTrials = 200;
    for (int i = 0; i < kTrials; ++i) {
        const BiasEstimate found = film_with(0.01, 0.2, static_cast<std::uint64_t>(100 + i)).estimate();
        sum += found.squared;
        squares += found.squared * found.squared;
        told += found.deviation;
    }
    const double deviation = std::sqrt(squares / kTrials - sum * sum / kTrials / kTrials);
    // 200 trials tell a deviation within 5 %, three times over.
    EXPECT_NEAR(told / kTrials, deviation, 0.15 * deviation);
}

TEST(BiasEstimate, noise_and_bias_add_as_squares) {
    const ErrorEstimate noise{.estimate = 0.03, .low = 0.02, .high = 0.04};
    const ErrorEstimate both = with_bias(noise, {.squared = 0.0016, .deviation = 0.0});
    EXPECT_DOUBLE_EQ(both.estimate, 0.05);
    EXPECT_DOUBLE_EQ(*both.noise, 0.03);
    EXPECT_DOUBLE_EQ(*both.bias, 0.04);
    EXPECT_LT(both.low, both.estimate);
    EXPECT_GT(both.high, both.estimate);
    EXPECT_DOUBLE_EQ(with_bias(noise, {.squared = -0.001, .deviation = 0.0}).estimate, 0.03);
}

}  // namespace
}  // namespace voxilux
