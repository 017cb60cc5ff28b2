#include "shared/two_float.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "support/two_float_cases.h"

namespace voxilux {
namespace {

using gpu::TwoFloat;
using test::relative_error;
using test::value_of;

constexpr int kCases = 200000;

TEST(TwoFloat, sum_and_product_of_floats_are_exact) {
    for (const auto& [a, b] : test::two_float_cases(kCases)) {
        const TwoFloat sum = gpu::two_sum(a.hi, b.hi);
        const TwoFloat product = gpu::two_prod(a.hi, b.hi);
        ASSERT_EQ(value_of(sum), static_cast<long double>(a.hi) + b.hi);
        ASSERT_EQ(value_of(product), static_cast<long double>(a.hi) * b.hi);
        ASSERT_EQ(sum.hi, a.hi + b.hi);
        const float large = std::max(std::abs(a.hi), std::abs(b.hi));
        const float small = std::min(std::abs(a.hi), std::abs(b.hi));
        ASSERT_EQ(value_of(gpu::quick_two_sum(large, small)), static_cast<long double>(large) + small);
    }
}

TEST(TwoFloat, arithmetic_has_at_most_the_promised_relative_error) {
    double add = 0.0;
    double mul = 0.0;
    double div = 0.0;
    double mul_float = 0.0;
    for (const auto& [a, b] : test::two_float_cases(kCases)) {
        add = std::max(add, relative_error(gpu::tf_add(a, b), value_of(a) + value_of(b)));
        mul = std::max(mul, relative_error(gpu::tf_mul(a, b), value_of(a) * value_of(b)));
        div = std::max(div, relative_error(gpu::tf_div(a, b), value_of(a) / value_of(b)));
        mul_float = std::max(mul_float, relative_error(gpu::tf_mul_float(a, b.hi), value_of(a) * b.hi));
    }
    RecordProperty("log2_errors", std::to_string(std::log2(add)) + " " + std::to_string(std::log2(mul)) +
                                      " " + std::to_string(std::log2(div)));
    EXPECT_LE(add, test::kTwoFloatError);
    EXPECT_LE(mul, test::kTwoFloatError);
    EXPECT_LE(div, test::kTwoFloatError);
    EXPECT_LE(mul_float, test::kTwoFloatError);
}

TEST(TwoFloat, plain_float_arithmetic_is_caught_as_too_coarse) {
    double worst = 0.0;
    for (const auto& [a, b] : test::two_float_cases(1000))
        worst = std::max(worst, relative_error(gpu::two_float(a.hi * b.hi, 0.0f), value_of(a) * value_of(b)));
    EXPECT_GT(worst, test::kTwoFloatError);
}

TEST(TwoFloat, zero_and_opposite_operands_give_exact_zeros) {
    const TwoFloat zero = gpu::two_float(0.0f, 0.0f);
    const TwoFloat third = test::to_two_float(1.0 / 3.0);
    EXPECT_EQ(value_of(gpu::tf_add(third, test::to_two_float(-1.0 / 3.0))), 0.0L);
    EXPECT_EQ(value_of(gpu::tf_mul(zero, third)), 0.0L);
    EXPECT_EQ(value_of(gpu::tf_div(zero, third)), 0.0L);
    EXPECT_EQ(value_of(gpu::tf_add(zero, third)), value_of(third));
}

// Where a ray that starts a million voxels away enters the world: a float keeps 4 fraction bits of such a
// distance.
TEST(TwoFloat, distance_over_a_million_voxels_keeps_a_millionth_of_a_voxel) {
    const double origin = -1000000.3;
    const double direction = 0.7310585;
    const TwoFloat t = gpu::tf_div(test::to_two_float(-origin), test::to_two_float(direction));
    EXPECT_NEAR(static_cast<double>(value_of(t)), -origin / direction, 1e-6);
    EXPECT_GT(std::abs(static_cast<double>(1000000.3f / 0.7310585f) + origin / direction), 1e-3);
}

}  // namespace
}  // namespace voxilux
