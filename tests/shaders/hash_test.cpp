#include "shared/hash.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "support/statistics.h"

namespace voxilux {
namespace {

using test::TestRandom;

constexpr int kTrials = 4096;

// Largest distance from one half of "input bit i flips output bit o", over all bits of four input words,
// where `hash` maps four words to one. Counters are small numbers, as in use, plus random ones.
template <typename Hash>
double worst_avalanche_bias(Hash hash, int words) {
    TestRandom random(1);
    std::array<std::array<int, 32>, 128> flips{};
    for (int trial = 0; trial < kTrials; ++trial) {
        std::array<std::uint32_t, 4> in{};
        for (std::uint32_t& word : in)
            word = trial % 2 == 0 ? random.bits32() : random.bits32() >> 20;
        const std::uint32_t base = hash(in);
        for (int bit = 0; bit < 32 * words; ++bit) {
            auto changed = in;
            changed[static_cast<std::size_t>(bit / 32)] ^= 1u << (bit % 32);
            const std::uint32_t difference = base ^ hash(changed);
            for (std::size_t out = 0; out < 32; ++out)
                flips[static_cast<std::size_t>(bit)][out] += (difference >> out) & 1u;
        }
    }
    double worst = 0.0;
    for (int bit = 0; bit < 32 * words; ++bit) {
        for (const int count : flips[static_cast<std::size_t>(bit)])
            worst = std::max(worst, std::abs(static_cast<double>(count) / kTrials - 0.5));
    }
    return worst;
}

// Six standard deviations of a fair coin thrown kTrials times: above the largest of 4096 such counts.
const double kFairCoinBound = 6.0 * 0.5 / std::sqrt(kTrials);

TEST(Hash, hash4_each_input_bit_flips_each_output_bit_half_the_time) {
    const auto hash = [](const auto& v) { return gpu::hash4(v[0], v[1], v[2], v[3]); };
    EXPECT_LT(worst_avalanche_bias(hash, 4), kFairCoinBound);
}

TEST(Hash, words_that_seed_the_sobol_scramble_are_as_good) {
    const auto y = [](const auto& v) { return gpu::pcg_hash(gpu::pcg4d({v[0], v[1], v[2], v[3]}).y); };
    const auto z = [](const auto& v) { return gpu::pcg_hash(gpu::pcg4d({v[0], v[1], v[2], v[3]}).z); };
    EXPECT_LT(worst_avalanche_bias(y, 4), kFairCoinBound);
    EXPECT_LT(worst_avalanche_bias(z, 4), kFairCoinBound);
}

TEST(Hash, first_word_of_pcg4d_is_caught_as_biased) {
    const auto x = [](const auto& v) { return gpu::pcg_hash(gpu::pcg4d({v[0], v[1], v[2], v[3]}).x); };
    EXPECT_GT(worst_avalanche_bias(x, 4), 2.0 * kFairCoinBound);
}

TEST(Hash, pcg_hash_avalanche_stays_within_a_tenth_of_half) {
    const auto hash = [](const auto& v) { return gpu::pcg_hash(v[0]); };
    EXPECT_LT(worst_avalanche_bias(hash, 1), 0.1);
}

TEST(Hash, avalanche_of_a_congruential_step_is_caught) {
    const auto weak = [](const auto& v) { return v[0] * 747796405u + 2891336453u; };
    EXPECT_GT(worst_avalanche_bias(weak, 1), 0.4);
}

TEST(Hash, pcg_hash_of_distinct_words_never_collides) {
    std::vector<std::uint32_t> values(1u << 20);
    for (std::uint32_t i = 0; i < values.size(); ++i)
        values[i] = gpu::pcg_hash(i * 4093u);
    std::sort(values.begin(), values.end());
    EXPECT_EQ(std::adjacent_find(values.begin(), values.end()), values.end());
}

// The published step written with 64-bit arithmetic and explicit reduction.
TEST(Hash, pcg_hash_equals_the_step_in_wide_arithmetic) {
    TestRandom random(2);
    for (int i = 0; i < 10000; ++i) {
        const std::uint32_t v = random.bits32();
        const std::uint64_t state = (v * 747796405ull + 2891336453ull) % (1ull << 32);
        const std::uint64_t shifted = (state >> ((state >> 28) + 4)) ^ state;
        const std::uint64_t word = (shifted * 277803737ull) % (1ull << 32);
        ASSERT_EQ(gpu::pcg_hash(v), (word >> 22) ^ word) << v;
    }
}

TEST(Hash, pcg3d_and_pcg4d_of_distinct_inputs_are_distinct) {
    std::vector<std::array<std::uint32_t, 4>> values;
    for (std::uint32_t i = 0; i < 1u << 16; ++i) {
        const gpu::uvec4 four = gpu::pcg4d(gpu::uvec4(i & 15u, (i >> 4) & 15u, (i >> 8) & 15u, i >> 12));
        const gpu::uvec3 three = gpu::pcg3d(gpu::uvec3(i & 31u, (i >> 5) & 31u, i >> 10));
        values.push_back({four.x, four.y, four.z, four.w});
        values.push_back({three.x, three.y, three.z, 0u});
    }
    std::sort(values.begin(), values.end());
    EXPECT_EQ(std::adjacent_find(values.begin(), values.end()), values.end());
}

}  // namespace
}  // namespace voxilux
