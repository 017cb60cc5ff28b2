#include "shared/film_sum.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "support/statistics.h"

namespace voxilux {
namespace {

using gpu::uvec2;

std::int64_t joined(uvec2 v) {
    return static_cast<std::int64_t>((static_cast<std::uint64_t>(v.y) << 32) | v.x);
}

uvec2 parted(std::int64_t v) {
    const auto bits = static_cast<std::uint64_t>(v);
    return {static_cast<std::uint32_t>(bits), static_cast<std::uint32_t>(bits >> 32)};
}

// value 2^24 rounded to nearest even by the C library; exact in double for a float below 2^19.
std::int64_t fixed_by_rint(float value) {
    return static_cast<std::int64_t>(std::nearbyint(static_cast<double>(value) * 0x1p24));
}

std::vector<float> edge_values() {
    std::vector<float> values;
    for (int exponent = -149; exponent <= 19; ++exponent) {
        const float power = std::ldexp(1.0f, exponent);
        for (const float v : {power, std::nextafter(power, 0.0f), 1.5f * power, 1.25f * power}) {
            if (v > gpu::kFilmMaxValue) continue;
            values.push_back(v);
            values.push_back(-v);
        }
    }
    values.insert(values.end(), {0.0f, -0.0f, std::numeric_limits<float>::denorm_min(), gpu::kFilmMaxValue});
    for (int i = 0; i < 64; ++i)
        values.push_back((static_cast<float>(i) + 0.5f) * 0x1p-24f);
    return values;
}

TEST(FilmSum, edge_values_convert_to_the_nearest_fraction_ties_to_even) {
    for (const float value : edge_values()) {
        const gpu::FilmFixed fixed = gpu::film_fixed(value);
        EXPECT_EQ(joined(fixed.sum), fixed_by_rint(value)) << value;
        EXPECT_EQ(fixed.flags, 0u) << value;
    }
}

TEST(FilmSum, random_bit_patterns_convert_as_doubles_do) {
    test::TestRandom random(7);
    for (int i = 0; i < 1000000; ++i) {
        const float value = gpu::uintBitsToFloat(random.bits32());
        if (!std::isfinite(value) || std::abs(value) > gpu::kFilmMaxValue) continue;
        ASSERT_EQ(joined(gpu::film_fixed(value).sum), fixed_by_rint(value)) << value;
    }
}

TEST(FilmSum, values_beyond_the_limit_are_clamped_and_flagged) {
    const std::int64_t largest = fixed_by_rint(gpu::kFilmMaxValue);
    for (const float value :
         {std::nextafter(gpu::kFilmMaxValue, 1e30f), 1e20f, std::numeric_limits<float>::max()}) {
        EXPECT_EQ(joined(gpu::film_fixed(value).sum), largest);
        EXPECT_EQ(joined(gpu::film_fixed(-value).sum), -largest);
        EXPECT_EQ(gpu::film_fixed(value).flags, gpu::kFilmClamped);
    }
    EXPECT_EQ(gpu::film_fixed(gpu::kFilmMaxValue).flags, 0u);
}

TEST(FilmSum, non_finite_values_are_zero_and_flagged) {
    const float inf = std::numeric_limits<float>::infinity();
    for (const float value : {inf, -inf, std::nanf(""), -std::nanf(""), gpu::uintBitsToFloat(0x7F800001u)}) {
        EXPECT_EQ(joined(gpu::film_fixed(value).sum), 0);
        EXPECT_EQ(gpu::film_fixed(value).flags, gpu::kFilmNonFinite);
    }
}

TEST(FilmSum, add_and_negate_equal_64_bit_integers) {
    std::vector<std::int64_t> values = {0,         1,        -1, 0xFFFFFFFFll, 0x100000000ll, -0x100000000ll,
                                        INT64_MAX, INT64_MIN};
    test::TestRandom random(8);
    for (int i = 0; i < 500; ++i)
        values.push_back(static_cast<std::int64_t>(random.bits64() >> (i % 60)));
    for (const std::int64_t a : values) {
        EXPECT_EQ(static_cast<std::uint64_t>(joined(gpu::film_negate(parted(a)))),
                  0 - static_cast<std::uint64_t>(a));
        for (const std::int64_t b : values) {
            const auto sum = static_cast<std::uint64_t>(a) + static_cast<std::uint64_t>(b);
            std::int64_t checked = 0;
            ASSERT_EQ(static_cast<std::uint64_t>(joined(gpu::film_add(parted(a), parted(b)))), sum);
            ASSERT_EQ(gpu::film_add_overflows(parted(a), parted(b)), __builtin_add_overflow(a, b, &checked));
        }
    }
}

TEST(FilmSum, a_million_largest_samples_stay_inside_the_sum) {
    const auto largest = joined(gpu::film_fixed(gpu::kFilmMaxValue).sum);
    EXPECT_LE(largest, INT64_MAX >> 20);
    EXPECT_FALSE(gpu::film_add_overflows(parted(largest * ((1 << 20) - 1)), parted(largest - 1)));
}

TEST(FilmSquare, equals_the_rounded_square_of_the_value_taken) {
    for (const float value : edge_values()) {
        const double taken = value;
        const double square = taken * taken;  // exact: 48 bits
        const double want = std::ldexp(square, gpu::kFilmFractionBits);
        // The product in float is rounded to 24 bits, then to a whole number.
        const double rounding = want * 0x1p-24 + 0.5;
        ASSERT_NEAR(static_cast<double>(joined(gpu::film_square(value))), want, rounding) << value;
        ASSERT_EQ(joined(gpu::film_square(value)), joined(gpu::film_square(-value)));
    }
    EXPECT_EQ(joined(gpu::film_square(3.0f)), std::int64_t{9} << 24);
    EXPECT_EQ(joined(gpu::film_square(-0.5f)), std::int64_t{1} << 22);
}

TEST(FilmSquare, is_of_the_value_that_the_sum_gets) {
    const std::int64_t largest = joined(gpu::film_square(gpu::kFilmMaxValue));
    EXPECT_GT(largest, (std::int64_t{1} << 62) - (std::int64_t{1} << 40));
    EXPECT_EQ(joined(gpu::film_square(1e9f)), largest);
    EXPECT_EQ(joined(gpu::film_square(-3e38f)), largest);
    const float inf = std::numeric_limits<float>::infinity();
    for (const float value : {inf, -inf, std::nanf("")})
        EXPECT_EQ(joined(gpu::film_square(value)), 0);
}

TEST(FilmSquare, sums_stop_at_the_largest_number_in_any_order) {
    const uvec2 large = gpu::film_square(gpu::kFilmMaxValue);
    const uvec2 small = gpu::film_square(7.0f);
    uvec2 forwards = gpu::film_add_square(gpu::film_add_square(large, large), small);
    uvec2 backwards = gpu::film_add_square(gpu::film_add_square(small, large), large);
    EXPECT_EQ(joined(gpu::film_add_square(large, small)), joined(large) + joined(small));
    EXPECT_EQ(joined(forwards), joined(backwards));
    forwards = gpu::film_add_square(forwards, large);
    backwards = gpu::film_add_square(backwards, large);
    EXPECT_EQ(joined(forwards), INT64_MAX);
    EXPECT_EQ(joined(backwards), INT64_MAX);
    // Without saturation it would be a negative square.
    EXPECT_LT(joined(gpu::film_add(gpu::film_add(large, large), gpu::film_add(large, small))), 0);
}

// A float sum of 0.1 stops growing near 2^24 samples of 1; the fixed sum keeps the mean.
TEST(FilmSum, mean_of_a_constant_stays_constant_over_2_to_the_24_samples) {
    const gpu::FilmFixed sample = gpu::film_fixed(0.1f);
    uvec2 sum(0u);
    float float_sum = 0.0f;
    constexpr int kCount = 1 << 24;
    for (int i = 0; i < kCount; ++i) {
        sum = gpu::film_add(sum, sample.sum);
        float_sum += 0.1f;
    }
    EXPECT_EQ(joined(sum), joined(sample.sum) * kCount);
    EXPECT_NEAR(static_cast<double>(joined(sum)) / kCount * 0x1p-24, 0.1, 0x1p-25);
    EXPECT_GT(std::abs(static_cast<double>(float_sum) / kCount - 0.1), 1e-3);
}

// Beyond 2^32 samples, the sum is doubled instead of drawing samples.
TEST(FilmSum, mean_of_a_constant_stays_constant_over_2_to_the_36_samples) {
    uvec2 sum = gpu::film_fixed(1.7f).sum;
    for (int doubling = 0; doubling < 36; ++doubling) {
        ASSERT_FALSE(gpu::film_add_overflows(sum, sum));
        sum = gpu::film_add(sum, sum);
    }
    EXPECT_NEAR(static_cast<double>(joined(sum)) * 0x1p-60, 1.7, 0x1p-24);
}

TEST(FilmSum, sum_does_not_depend_on_the_order_of_the_samples) {
    test::TestRandom random(9);
    std::vector<float> samples(10000);
    for (float& sample : samples)
        sample = static_cast<float>(std::exp(random.uniform(-20.0, 12.0)));
    uvec2 forwards(0u);
    uvec2 backwards(0u);
    float float_forwards = 0.0f;
    float float_backwards = 0.0f;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const float other = samples[samples.size() - 1 - i];
        forwards = gpu::film_add(forwards, gpu::film_fixed(samples[i]).sum);
        backwards = gpu::film_add(backwards, gpu::film_fixed(other).sum);
        float_forwards += samples[i];
        float_backwards += other;
    }
    EXPECT_EQ(forwards, backwards);
    EXPECT_NE(float_forwards, float_backwards);
}

TEST(FilmSum, sums_become_floats_within_their_rounding) {
    for (const float value : edge_values()) {
        const double exact = static_cast<double>(joined(gpu::film_fixed(value).sum)) * 0x1p-24;
        ASSERT_NEAR(static_cast<double>(gpu::film_float(gpu::film_fixed(value).sum)), exact,
                    std::abs(exact) * 0x1p-22)
            << value;
    }
    EXPECT_EQ(gpu::film_float(parted(-1)), -0x1p-24f) << "words of a small negative sum are large";
    EXPECT_EQ(gpu::film_float(parted(0)), 0.0f);
}

}  // namespace
}  // namespace voxilux
