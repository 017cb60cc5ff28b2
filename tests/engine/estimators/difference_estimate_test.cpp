#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <string>

#include "base/statistics.h"
#include "estimators/difference_estimate.h"
#include "estimators/metrics.h"
#include "support/test_images.h"

namespace voxilux {
namespace {

constexpr int kEdge = 64;

Image flat(float value) {
    return test::constant_image(kEdge, kEdge, value);
}

// Noise as the discs of photons make it: the same for the pixels of an 8 x 8 tile.
void add_coarse_noise(Image& image, double deviation, std::mt19937& random) {
    std::normal_distribution<double> noise(0.0, deviation);
    std::array<double, 64> tiles;
    for (double& tile : tiles)
        tile = noise(random);
    for (auto& [name, channel] : image.channels)
        for (int y = 0; y < kEdge; ++y)
            for (int x = 0; x < kEdge; ++x)
                channel.pixels[static_cast<std::size_t>(y * kEdge + x)] +=
                    static_cast<float>(tiles[static_cast<std::size_t>(y / 8 * 8 + x / 8)]);
}

struct Pictures {
    std::vector<Image> tests, bases;

    [[nodiscard]] SquareEstimate estimate(const Image* radiance = nullptr) const {
        std::vector<DifferenceTrial> trials;
        for (std::size_t k = 0; k < tests.size(); ++k)
            trials.push_back({&tests[k], &bases[k]});
        return estimate_difference(trials, radiance);
    }
};

// A radiance of 0.5 that is `bias` off, both with noise of their own.
Pictures noisy(double bias, double deviation, std::uint32_t seed, std::size_t trials = 3) {
    std::mt19937 random(seed);
    Pictures pictures;
    for (std::size_t k = 0; k < trials; ++k) {
        pictures.tests.push_back(flat(0.5f + static_cast<float>(bias)));
        pictures.bases.push_back(flat(0.5f));
        test::add_noise(pictures.tests.back(), deviation, random);
        test::add_noise(pictures.bases.back(), 0.02, random);
    }
    return pictures;
}

double square_of(double bias) {
    return bias * bias / (0.25 + kRelMseEpsilon);
}

TEST(DifferenceEstimate, of_equal_pictures_is_exactly_zero_and_not_beyond_noise) {
    Pictures pictures = noisy(0.0, 0.1, 1);
    pictures.tests = pictures.bases;
    const SquareEstimate estimate = pictures.estimate();
    EXPECT_EQ(estimate.squared, 0.0);
    EXPECT_EQ(estimate.high, 0.0);
    EXPECT_FALSE(estimate.is_beyond_noise());
}

TEST(DifferenceEstimate, without_noise_is_the_relative_square_at_no_width) {
    const Image test = flat(0.75f), base = flat(0.5f);
    const std::array<DifferenceTrial, 3> trials = {
        DifferenceTrial{&test, &base}, {&test, &base}, {&test, &base}};
    const SquareEstimate estimate = estimate_difference(trials);
    EXPECT_NEAR(estimate.squared, square_of(0.25), 1e-12);
    EXPECT_NEAR(estimate.high - estimate.low, 0.0, 1e-12);
    EXPECT_TRUE(estimate.is_beyond_noise());
}

TEST(DifferenceEstimate, interval_holds_a_bias_below_the_noise_in_nineteen_of_twenty_runs) {
    int held = 0, beyond = 0;
    for (std::uint32_t seed = 0; seed < 100; ++seed) {
        const SquareEstimate estimate = noisy(0.02, 0.1, seed).estimate();
        held += estimate.low <= square_of(0.02) && square_of(0.02) <= estimate.high ? 1 : 0;
        beyond += estimate.is_beyond_noise() ? 1 : 0;
    }
    EXPECT_GE(held, 88);  // 95 expected at least; three deviations are 7 less
    EXPECT_EQ(beyond, 100);
}

// Negative control: a wrong truth lies outside.
TEST(DifferenceEstimate, interval_rejects_another_bias) {
    int held = 0;
    for (std::uint32_t seed = 0; seed < 50; ++seed) {
        const SquareEstimate estimate = noisy(0.02, 0.1, seed).estimate();
        held += estimate.low <= square_of(0.04) && square_of(0.04) <= estimate.high ? 1 : 0;
    }
    EXPECT_LE(held, 2);
}

TEST(DifferenceEstimate, noise_alone_is_hardly_ever_beyond_noise) {
    int beyond = 0;
    for (std::uint32_t seed = 0; seed < 100; ++seed)
        beyond += noisy(0.0, 0.1, seed).estimate().is_beyond_noise() ? 1 : 0;
    EXPECT_LE(beyond, 5);
}

TEST(DifferenceEstimate, noise_that_neighbours_share_is_hardly_ever_beyond_noise) {
    int beyond = 0;
    for (std::uint32_t seed = 0; seed < 100; ++seed) {
        std::mt19937 random(seed);
        Pictures pictures = noisy(0.0, 0.01, seed);
        for (Image& test : pictures.tests)
            add_coarse_noise(test, 0.1, random);
        beyond += pictures.estimate().is_beyond_noise() ? 1 : 0;
    }
    EXPECT_LE(beyond, 5);
}

TEST(DifferenceEstimate, small_bright_spot_is_beyond_noise) {
    Pictures pictures = noisy(0.0, 0.01, 7);
    for (Image& test : pictures.tests)
        for (std::size_t i = 0; i < 6; ++i)
            test.channels.at("R").pixels[20 * kEdge + 20 + i] += 0.3f;
    const SquareEstimate estimate = pictures.estimate();
    EXPECT_TRUE(estimate.is_beyond_noise());
    const double truth = 6.0 * square_of(0.3) / (3.0 * kEdge * kEdge);
    EXPECT_NEAR(estimate.squared, truth, 0.2 * truth);
}

// A picture whose noise is a few very bright pixels, with a dark corner, against an all-black one.
TEST(DifferenceEstimate, large_difference_among_fireflies_is_beyond_noise) {
    std::mt19937 random(11);
    std::uniform_int_distribution<std::size_t> place(0, kEdge * kEdge - 1);
    Pictures pictures;
    for (int k = 0; k < 3; ++k) {
        pictures.tests.push_back(flat(0.0f));
        pictures.bases.push_back(flat(0.2f));
        test::add_noise(pictures.bases.back(), 0.15, random);
        for (int i = 0; i < 200; ++i)
            pictures.bases.back().channels.at("G").pixels[place(random)] = 50.0f;
    }
    EXPECT_TRUE(pictures.estimate().is_beyond_noise());
}

// Negative control: the same fireflies on both sides, and no difference.
TEST(DifferenceEstimate, fireflies_alone_are_hardly_ever_beyond_noise) {
    int beyond = 0;
    for (std::uint32_t seed = 0; seed < 100; ++seed) {
        std::mt19937 random(seed);
        std::uniform_int_distribution<std::size_t> place(0, kEdge * kEdge - 1);
        Pictures pictures = noisy(0.0, 0.1, seed);
        for (std::size_t k = 0; k < 3; ++k) {
            for (int i = 0; i < 100; ++i) {
                pictures.tests[k].channels.at("G").pixels[place(random)] = 50.0f;
                pictures.bases[k].channels.at("G").pixels[place(random)] = 50.0f;
            }
        }
        beyond += pictures.estimate().is_beyond_noise() ? 1 : 0;
    }
    EXPECT_LE(beyond, 5);
}

TEST(DifferenceEstimate, against_a_given_radiance_divides_by_that) {
    const Pictures pictures = noisy(0.1, 0.02, 3, 4);
    const Image radiance = flat(2.0f);
    EXPECT_NEAR(pictures.estimate(&radiance).squared, 0.01 / (4.0 + kRelMseEpsilon), 1e-4);
}

TEST(StudentQuantile, is_that_of_tables) {
    const std::array<std::pair<double, double>, 7> table = {
        {{1, 12.706}, {2, 4.303}, {3, 3.182}, {4, 2.776}, {8, 2.306}, {30, 2.042}, {1e9, 1.960}}};
    for (const auto& [degrees, quantile] : table)
        EXPECT_NEAR(student_quantile_95(degrees), quantile, 2e-3 * quantile) << degrees;
}

}  // namespace
}  // namespace voxilux
