#include "shared/sequence.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "shared/sampling.h"
#include "support/integrands.h"
#include "support/statistics.h"

namespace voxilux {
namespace {

using gpu::SampleKey;
using test::WallCorner;

constexpr std::array<std::uint32_t, 3> kSequences = {gpu::kSequenceSobol, gpu::kSequenceHalton,
                                                     gpu::kSequenceWhite};

WallCorner wall_of(std::uint32_t pixel) {
    test::TestRandom random(pixel);
    return {.angle = random.uniform(0.0, 6.28), .height = random.uniform(0.3, 3.0)};
}

double ao_error(std::uint32_t pixel, glm::vec2 u) {
    const WallCorner wall = wall_of(pixel);
    return wall.visible(gpu::cosine_hemisphere(u)) - wall.mean();
}

double smooth_error(std::uint32_t, glm::vec2 u) {
    return test::smooth_integrand(u) - test::smooth_mean();
}

// Root mean square over the pixels of the error of the mean of the first N samples, for N = first, 2 first,
// ...
template <typename Error>
std::vector<double> rmse_table(std::uint32_t sequence, std::uint32_t pixels, std::uint32_t first,
                               std::uint32_t last, Error error) {
    std::vector<double> squares;
    for (std::uint32_t pixel = 0; pixel < pixels; ++pixel) {
        double sum = 0.0;
        std::size_t row = 0;
        std::uint32_t next = first;
        for (std::uint32_t i = 0; i < last; ++i) {
            sum += error(pixel, gpu::sample_2d(sequence, SampleKey{pixel, i, 1}, 0));
            if (i + 1 != next) continue;
            squares.resize(std::max(squares.size(), row + 1));
            squares[row++] += (sum / next) * (sum / next);
            next *= 2;
        }
    }
    for (double& square : squares)
        square = std::sqrt(square / pixels);
    return squares;
}

template <typename Error>
std::array<std::vector<double>, 3> print_table(const char* title, std::uint32_t pixels, std::uint32_t first,
                                               std::uint32_t last, Error error) {
    std::array<std::vector<double>, 3> tables;
    for (const std::uint32_t sequence : kSequences)
        tables[sequence] = rmse_table(sequence, pixels, first, last, error);
    std::printf("RMSE of %s over %u pixels\n%8s %11s %11s %11s\n", title, pixels, "samples", "sobol",
                "halton", "white");
    for (std::size_t row = 0; row < tables[0].size(); ++row)
        std::printf("%8u %11.3e %11.3e %11.3e\n", first << row, tables[0][row], tables[1][row],
                    tables[2][row]);
    return tables;
}

double slope(const std::vector<double>& table) {
    return std::log2(table.back() / table.front()) / static_cast<double>(table.size() - 1);
}

void expect_sobol_below_halton_below_white(const std::array<std::vector<double>, 3>& tables) {
    for (std::size_t row = 0; row < tables[0].size(); ++row) {
        EXPECT_LE(tables[gpu::kSequenceSobol][row], tables[gpu::kSequenceHalton][row]) << "row " << row;
        EXPECT_LE(tables[gpu::kSequenceHalton][row], tables[gpu::kSequenceWhite][row]) << "row " << row;
    }
}

TEST(Sequence, ao_error_of_sobol_is_at_most_halton_is_at_most_white) {
    expect_sobol_below_halton_below_white(print_table("AO beside a wall", 64, 256, 4096, ao_error));
}

// The first samples are what a preview shows. One sample is white noise in any sequence.
TEST(Sequence, ao_error_of_2_to_128_samples_of_sobol_is_below_halton_is_below_white) {
    auto tables = print_table("AO beside a wall", 1024, 1, 128, ao_error);
    for (std::vector<double>& table : tables)
        table.erase(table.begin());
    expect_sobol_below_halton_below_white(tables);
}

TEST(Sequence, smooth_error_of_sobol_is_at_most_halton_is_at_most_white) {
    expect_sobol_below_halton_below_white(print_table("exp(x + y)", 64, 256, 4096, smooth_error));
}

TEST(Sequence, sobol_error_does_not_flatten_to_65536_samples) {
    const auto ao = print_table("AO beside a wall", 16, 64, 65536, ao_error);
    EXPECT_LT(slope(ao[gpu::kSequenceSobol]), -0.65);
    EXPECT_NEAR(slope(ao[gpu::kSequenceWhite]), -0.5, 0.15);
}

TEST(Sequence, sobol_error_of_a_smooth_integrand_does_not_flatten_to_65536_samples) {
    const auto smooth = print_table("exp(x + y)", 16, 64, 65536, smooth_error);
    EXPECT_LT(slope(smooth[gpu::kSequenceSobol]), -1.2);
}

// The Halton rotation repeats after 8192 frames, so its error cannot fall below that of 8192 samples.
TEST(Sequence, halton_error_flattens_after_its_period_and_the_slope_check_sees_it) {
    const auto error = rmse_table(gpu::kSequenceHalton, 8, 8192, 65536, ao_error);
    EXPECT_GT(slope(error), -0.2);
}

TEST(Sequence, one_dimension_is_a_coordinate_of_its_pair) {
    for (const std::uint32_t sequence : kSequences) {
        for (std::uint32_t pair = 0; pair < 10; ++pair) {
            const SampleKey key{3, 1000 + pair, 5};
            const glm::vec2 p = gpu::sample_2d(sequence, key, pair);
            EXPECT_EQ(p.x, gpu::sample_1d(sequence, key, 2 * pair));
            EXPECT_EQ(p.y, gpu::sample_1d(sequence, key, 2 * pair + 1));
        }
    }
}

TEST(Sequence, values_lie_in_the_half_open_unit_interval) {
    test::TestRandom random(5);
    for (const std::uint32_t sequence : kSequences) {
        for (int i = 0; i < 200000; ++i) {
            const SampleKey key{random.bits32(), random.bits32(), random.bits32()};
            const float u = gpu::sample_1d(sequence, key, random.bits32() % 16);
            ASSERT_GE(u, 0.0f);
            ASSERT_LT(u, 1.0f);
        }
    }
}

// The points of 256 pixels for one frame; two frames repeat when the sets share more than chance allows.
std::set<std::pair<float, float>> frame_points(std::uint32_t sequence, glm::uvec2 index, std::uint32_t seed) {
    std::set<std::pair<float, float>> points;
    for (std::uint32_t pixel = 0; pixel < 256; ++pixel) {
        const glm::vec2 p = gpu::sample_2d(sequence, gpu::sample_key(pixel, index, seed), 0);
        points.emplace(p.x, p.y);
    }
    return points;
}

std::size_t count_shared(const std::set<std::pair<float, float>>& a,
                         const std::set<std::pair<float, float>>& b) {
    std::size_t shared = 0;
    for (const auto& point : a)
        shared += b.count(point);
    return shared;
}

TEST(Sequence, frames_at_wraps_and_extreme_seeds_share_no_points_with_frame_zero) {
    for (const std::uint32_t sequence : {gpu::kSequenceSobol, gpu::kSequenceWhite}) {
        const auto zero = frame_points(sequence, {0, 0}, 0);
        EXPECT_EQ(zero.size(), 256u);
        for (const glm::uvec2 index : {glm::uvec2(8192, 0), glm::uvec2(65536, 0), glm::uvec2(1u << 24, 0),
                                       glm::uvec2(0xFFFFFFFFu, 0), glm::uvec2(0, 1), glm::uvec2(0, 2)})
            EXPECT_EQ(count_shared(zero, frame_points(sequence, index, 0)), 0u) << index.x << ' ' << index.y;
        for (const std::uint32_t seed : {1u, 0x80000000u, 0xFFFFFFFFu})
            EXPECT_EQ(count_shared(zero, frame_points(sequence, {0, 0}, seed)), 0u) << seed;
    }
}

TEST(Sequence, frame_repetition_of_halton_is_seen_by_the_same_check) {
    const auto zero = frame_points(gpu::kSequenceHalton, {0, 0}, 0);
    EXPECT_EQ(count_shared(zero, frame_points(gpu::kSequenceHalton, {8192, 0}, 0)), 256u);
    EXPECT_EQ(count_shared(zero, frame_points(gpu::kSequenceHalton, {0, 0}, 0xFFFFFFFFu)), 0u);
}

// Pairs of dimensions must not be correlated: mean of (x - 1/2)(y - 1/2) is 0 with standard error 1 / (12
// sqrt(N)) or less, for two coordinates taken from different pairs and from neighbouring pixels.
TEST(Sequence, different_pairs_and_neighbouring_pixels_are_uncorrelated) {
    constexpr std::uint32_t kCount = 65536;
    for (const std::uint32_t sequence : {gpu::kSequenceSobol, gpu::kSequenceWhite}) {
        double pairs = 0.0;
        double pixels = 0.0;
        for (std::uint32_t i = 0; i < kCount; ++i) {
            const SampleKey key{i >> 4, i & 15u, 9};
            const SampleKey right{(i >> 4) + 1, i & 15u, 9};
            const double u = gpu::sample_2d(sequence, key, 0).x - 0.5;
            pairs += u * (gpu::sample_2d(sequence, key, 1).x - 0.5);
            pixels += u * (gpu::sample_2d(sequence, right, 0).x - 0.5);
        }
        const double bound = 4.0 / (12.0 * std::sqrt(kCount));
        EXPECT_NEAR(pairs / kCount, 0.0, bound);
        EXPECT_NEAR(pixels / kCount, 0.0, bound);
    }
}

}  // namespace
}  // namespace voxilux
