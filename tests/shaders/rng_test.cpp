#include "shared/rng.h"

#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "support/statistics.h"

namespace voxilux {
namespace {

constexpr std::size_t kBins = 32;
constexpr std::uint32_t kRandomDraws = 1000000;

// Chi-square of the pair (draw(i), draw(i + 1)) over kBins^2 equal cells.
template <typename Draw>
double pair_chi_square(Draw draw) {
    std::vector<std::uint64_t> seen(kBins * kBins, 0);
    float previous = draw(0);
    for (std::uint32_t i = 1; i <= kRandomDraws; ++i) {
        const float next = draw(i);
        const auto column = static_cast<std::size_t>(previous * static_cast<float>(kBins));
        const auto row = static_cast<std::size_t>(next * static_cast<float>(kBins));
        ++seen[row * kBins + column];
        previous = next;
    }
    const std::vector<double> expected(seen.size(),
                                       static_cast<double>(kRandomDraws) / static_cast<double>(seen.size()));
    return test::chi_square(seen, expected);
}

TEST(Rng, float_of_all_ones_is_below_one_and_of_zero_is_zero) {
    EXPECT_LT(gpu::unit_float(0xFFFFFFFFu), 1.0f);
    EXPECT_EQ(gpu::unit_float(0xFFFFFFFFu), 1.0f - 0x1p-24f);
    EXPECT_EQ(gpu::unit_float(0u), 0.0f);
    EXPECT_EQ(gpu::unit_float(0x80000000u), 0.5f);
}

TEST(Rng, successive_indices_are_uniform_in_pairs) {
    const auto draw = [](std::uint32_t i) { return gpu::rng_float(7, 123, i, 3); };
    EXPECT_LT(pair_chi_square(draw), test::chi_square_critical_99(kBins * kBins - 1));
}

TEST(Rng, successive_streams_are_uniform_in_pairs) {
    const auto draw = [](std::uint32_t i) { return gpu::rng_float(7, i, 0, 0); };
    EXPECT_LT(pair_chi_square(draw), test::chi_square_critical_99(kBins * kBins - 1));
}

TEST(Rng, successive_seeds_are_uniform_in_pairs) {
    const auto draw = [](std::uint32_t i) { return gpu::rng_float(i, 0, 0, 0); };
    EXPECT_LT(pair_chi_square(draw), test::chi_square_critical_99(kBins * kBins - 1));
}

TEST(Rng, successive_dimensions_are_uniform_in_pairs) {
    const auto draw = [](std::uint32_t i) { return gpu::rng_float(1, 2, 3, i); };
    EXPECT_LT(pair_chi_square(draw), test::chi_square_critical_99(kBins * kBins - 1));
}

TEST(Rng, a_density_tilted_by_three_percent_is_caught) {
    const auto draw = [](std::uint32_t i) {
        const float u = gpu::rng_float(7, 123, i, 3);
        return u + 0.03f * u * (1.0f - u);
    };
    EXPECT_GT(pair_chi_square(draw), test::chi_square_critical_99(kBins * kBins - 1));
}

double stream_chi_square(gpu::NoiseStream stream) {
    return pair_chi_square([&](std::uint32_t) {
        const float u = gpu::stream_float(stream);
        stream = gpu::stream_after(stream);
        return u;
    });
}

// As photons draw: one stream after the other, a few numbers of each.
double short_streams_chi_square(std::uint32_t length) {
    gpu::NoiseStream stream{};
    return pair_chi_square([&](std::uint32_t i) {
        if (i % length == 0)
            stream = {gpu::rng_uint(1, 2, i / length, 96), 2 * (i / length) + 1};
        else
            stream = gpu::stream_after(stream);
        return gpu::stream_float(stream);
    });
}

TEST(Rng, streams_are_uniform_in_pairs) {
    const double limit = test::chi_square_critical_99(kBins * kBins - 1);
    for (const std::uint32_t increment : {1u, 2891336453u, 131071u})
        EXPECT_LT(stream_chi_square({12345u, increment}), limit) << increment;
    for (const std::uint32_t length : {1u, 5u, 130u})
        EXPECT_LT(short_streams_chi_square(length), limit) << length;
    // Negative control: with an even increment an even state loses its low bits.
    EXPECT_GT(stream_chi_square({0u, 0x80000000u}), limit);
}

}  // namespace
}  // namespace voxilux
