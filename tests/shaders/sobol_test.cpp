#include "shared/sobol.h"

#include <array>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "shared/halton.h"
#include "support/statistics.h"

namespace voxilux {
namespace {

using gpu::uvec2;

// The second dimension from the direction numbers v_j = v_(j-1) ^ (v_(j-1) >> 1), v_0 = 2^31 (Sobol' 1967;
// Joe and Kuo 2008, dimension 2: s = 1, a = 0, m = 1).
std::uint32_t second_by_direction_numbers(std::uint32_t index) {
    std::uint32_t sum = 0;
    for (std::uint32_t direction = 0x80000000u; index != 0; index >>= 1, direction ^= direction >> 1)
        if ((index & 1u) != 0) sum ^= direction;
    return sum;
}

// Counts the elementary intervals of the 2^m points that do not hold exactly one of them: zero for a
// (0,m,2)-net.
int count_net_violations(const std::vector<uvec2>& points, int m) {
    int violations = 0;
    std::vector<std::uint8_t> held(points.size());
    for (int columns = 0; columns <= m; ++columns) {
        const int rows = m - columns;
        std::fill(held.begin(), held.end(), std::uint8_t{0});
        for (const uvec2 p : points) {
            const std::uint32_t column = columns == 0 ? 0 : p.x >> (32 - columns);
            const std::uint32_t row = rows == 0 ? 0 : p.y >> (32 - rows);
            std::uint8_t& count = held[(row << columns) | column];
            if (count < 255) ++count;
        }
        for (const std::uint8_t count : held)
            violations += count != 1 ? 1 : 0;
    }
    return violations;
}

template <typename Draw>
std::vector<uvec2> draw_points(std::uint32_t first, int m, Draw draw) {
    std::vector<uvec2> points;
    for (std::uint32_t i = 0; i < 1u << m; ++i)
        points.push_back(draw(first + i));
    return points;
}

TEST(Sobol, second_dimension_equals_direction_numbers) {
    for (std::uint32_t i = 0; i < 1u << 16; ++i)
        ASSERT_EQ(gpu::sobol_second(i), second_by_direction_numbers(i)) << i;
    test::TestRandom random(3);
    for (int i = 0; i < 100000; ++i) {
        const std::uint32_t index = random.bits32();
        ASSERT_EQ(gpu::sobol_second(index), second_by_direction_numbers(index)) << index;
    }
}

TEST(Sobol, scramble_flips_each_bit_by_the_bits_above_it_only) {
    test::TestRandom random(4);
    for (int i = 0; i < 2000; ++i) {
        const std::uint32_t v = random.bits32();
        const std::uint32_t seed = random.bits32();
        for (int bit = 0; bit < 32; ++bit) {
            const std::uint32_t changed =
                gpu::owen_scramble(v, seed) ^ gpu::owen_scramble(v ^ (1u << bit), seed);
            ASSERT_EQ(changed >> bit, 1u) << "bit " << bit << " value " << v << " seed " << seed;
        }
    }
}

TEST(Sobol, scrambled_points_hold_one_point_in_every_elementary_interval) {
    for (const std::uint32_t stream : {0u, 1u, 640u * 360u, 0xFFFFFFFFu}) {
        for (int m = 0; m <= 12; ++m) {
            const auto draw = [&](std::uint32_t i) { return gpu::sobol_pair(11, stream, i, stream & 7u); };
            EXPECT_EQ(count_net_violations(draw_points(0, m, draw), m), 0)
                << "stream " << stream << " m " << m;
        }
    }
}

TEST(Sobol, later_aligned_blocks_are_nets_too) {
    const auto draw = [](std::uint32_t i) { return gpu::sobol_pair(0, 42, i, 1); };
    for (const std::uint32_t first : {1024u, 8192u, 1u << 24, 0xFFFFFC00u})
        EXPECT_EQ(count_net_violations(draw_points(first, 10, draw), 10), 0) << "from " << first;
}

TEST(Sobol, net_check_rejects_halton_white_noise_and_one_moved_point) {
    const auto halton = [](std::uint32_t i) {
        return uvec2(gpu::radical_inverse_24(i, 2) << 8, gpu::radical_inverse_24(i, 3) << 8);
    };
    const auto white = [](std::uint32_t i) {
        return uvec2(gpu::rng_uint(0, 0, i, 0), gpu::rng_uint(0, 0, i, 1));
    };
    EXPECT_GT(count_net_violations(draw_points(0, 8, halton), 8), 0);
    EXPECT_GT(count_net_violations(draw_points(0, 8, white), 8), 0);
    auto moved = draw_points(0, 8, [](std::uint32_t i) { return gpu::sobol_pair(0, 0, i, 0); });
    moved[17].x ^= 0x80000000u;
    EXPECT_GT(count_net_violations(moved, 8), 0);
}

TEST(Sobol, each_bit_of_the_scramble_is_uniform_over_streams) {
    constexpr std::size_t kSobolBins = 256;
    constexpr std::uint32_t kStreams = 200000;
    std::vector<std::uint64_t> seen(2 * kSobolBins, 0);
    for (std::uint32_t stream = 0; stream < kStreams; ++stream) {
        const uvec2 p = gpu::sobol_pair(0, stream, 0, 0);
        ++seen[p.x >> 24];
        ++seen[kSobolBins + (p.y >> 24)];
    }
    const std::vector<double> expected(2 * kSobolBins, kStreams / static_cast<double>(kSobolBins));
    EXPECT_LT(test::chi_square(seen, expected), test::chi_square_critical_99(2 * (kSobolBins - 1)));
}

}  // namespace
}  // namespace voxilux
