// How evenly the pairs of a group of the Sobol' sequence fill the space of all their dimensions together.

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "shared/sobol.h"

namespace voxilux {
namespace {

using Point = std::array<std::uint32_t, 4>;

// The first 2^m points of two pairs of one stream.
std::vector<Point> draw_group_points(int m, gpu::uint first_pair, gpu::uint second_pair) {
    std::vector<Point> points;
    for (gpu::uint i = 0; i < 1u << m; ++i) {
        const gpu::uvec2 a = gpu::sobol_pair(5, 77, i, first_pair);
        const gpu::uvec2 b = gpu::sobol_pair(5, 77, i, second_pair);
        points.push_back({a.x, a.y, b.x, b.y});
    }
    return points;
}

std::uint32_t leading(std::uint32_t value, int bits) {
    return bits == 0 ? 0 : value >> (32 - bits);
}

// Whether every elementary interval of volume 2^(t - m) holds exactly 2^t points: a (t, m, 4)-net.
bool is_net(const std::vector<Point>& points, int m, int t) {
    const int bits = m - t;
    for (int a = 0; a <= bits; ++a) {
        for (int b = 0; a + b <= bits; ++b) {
            for (int c = 0; a + b + c <= bits; ++c) {
                const int d = bits - a - b - c;
                std::vector<int> held(std::size_t{1} << bits);
                for (const Point& p : points)
                    ++held[((leading(p[0], a) << b | leading(p[1], b)) << c | leading(p[2], c)) << d |
                           leading(p[3], d)];
                for (const int count : held) {
                    if (count != 1 << t) return false;
                }
            }
        }
    }
    return true;
}

int t_value(const std::vector<Point>& points, int m) {
    int t = 0;
    while (!is_net(points, m, t))
        ++t;
    return t;
}

std::vector<int> t_values(gpu::uint first_pair, gpu::uint second_pair) {
    std::vector<int> values;
    for (int m = 1; m <= 10; ++m)
        values.push_back(t_value(draw_group_points(m, first_pair, second_pair), m));
    return values;
}

TEST(SobolGroup, first_two_pairs_are_the_net_that_the_search_found) {
    EXPECT_EQ(t_values(0, 1), (std::vector<int>{0, 1, 1, 1, 2, 1, 2, 2, 3, 3}));
    EXPECT_EQ(t_values(3, 4), t_values(0, 1)) << "every group has the same structure";
}

TEST(SobolGroup, third_pair_is_a_good_net_with_the_first) {
    for (const int t : t_values(0, 2))
        EXPECT_LE(t, 5);
}

TEST(SobolGroup, net_check_tells_pairs_of_different_groups_apart) {
    const std::vector<int> strangers = t_values(0, 3);
    EXPECT_GT(strangers.back(), 3) << "independent shuffles share no structure";
}

TEST(SobolGroup, order_is_a_bijection_of_every_aligned_block) {
    for (gpu::uint place = 0; place < gpu::kSobolGroup; ++place) {
        for (const int m : {1, 3, 10, 14, 16}) {
            for (const gpu::uint block : {0u, 1u, 5u}) {
                std::vector<bool> seen(std::size_t{1} << m);
                const gpu::uint first = block << m;
                const gpu::uint image = gpu::sobol_reorder(first, place) >> m;
                for (gpu::uint i = 0; i < 1u << m; ++i) {
                    const gpu::uint order = gpu::sobol_reorder(first + i, place);
                    ASSERT_EQ(order >> m, image);
                    seen[order & ((1u << m) - 1u)] = true;
                }
                EXPECT_EQ(std::count(seen.begin(), seen.end(), true), 1 << m);
            }
        }
    }
}

}  // namespace
}  // namespace voxilux
