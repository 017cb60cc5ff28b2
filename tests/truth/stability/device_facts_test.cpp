// How the device evaluates expressions that GLSL leaves open. The table is printed for the reader. Only what
// our shaders rely on is asserted, so the test holds on every device that they run on.

#include "probe/device_facts.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "support/probe.h"

namespace voxilux {
namespace {

using gpu::FactInputs;
using gpu::FactResults;

FactInputs inputs() {
    const float inf = std::numeric_limits<float>::infinity();
    return {.nan = std::numeric_limits<float>::quiet_NaN(),
            .inf = inf,
            .other_inf = inf,
            .zero = 0.0f,
            .neg_zero = -0.0f,
            .one = 1.0f,
            .half_ = 0.5f,
            .neg_one = -1.0f,
            .denormal = 1e-40f,
            .small_negative = -1e-10f,
            .tiny = 1e-30f,
            .large = 1e20f,
            .huge = 1e30f,
            .above_one = std::nextafter(1.0f, 2.0f),
            .zero_word = 0,
            .seven = 7,
            .thirty_two = 32};
}

const FactResults& facts() {
    static const FactResults results = run_probe<FactInputs, FactResults>("device_facts", {inputs()}).at(0);
    return results;
}

void print_float(const char* expression, std::uint32_t bits) {
    fmt::print("  {:<24} {:>14} (0x{:08X})\n", expression, std::bit_cast<float>(bits), bits);
}

void print_word(const char* expression, std::uint32_t word) {
    fmt::print("  {:<24} 0x{:08X}\n", expression, word);
}

void print_floats(const FactResults& r) {
    print_float("min(NaN, 1)", r.min_nan_one);
    print_float("min(1, NaN)", r.min_one_nan);
    print_float("max(NaN, 1)", r.max_nan_one);
    print_float("max(1, NaN)", r.max_one_nan);
    print_float("clamp(NaN, 0, 1)", r.clamp_nan);
    print_float("1 / 0", r.one_over_zero);
    print_float("1 / -0", r.one_over_neg_zero);
    print_float("inf - inf", r.inf_minus_inf);
    print_float("inf - inf, precise", r.inf_minus_inf_precise);
    print_float("0 * inf", r.zero_times_inf);
    print_float("0 / 0", r.zero_over_zero);
    print_float("denormal * 1", r.denormal_times_one);
    print_float("denormal * 0.5", r.denormal_times_half);
    print_float("fract(-1e-10)", r.fract_small_negative);
    print_float("pow(0, 0)", r.pow_zero_zero);
    print_float("normalize(0).x", r.normalize_zero);
    print_float("normalize(1e-30).x", r.normalize_tiny);
    print_float("normalize(1e30).x", r.normalize_huge);
    print_float("length(1e20)", r.length_large);
    print_float("sign(NaN)", r.sign_nan);
    print_float("acos(1.0000001)", r.acos_above_one);
    print_float("sqrt(-1)", r.sqrt_neg_one);
}

void print_integers(const FactResults& r) {
    print_word("uint(NaN)", r.uint_of_nan);
    print_word("uint(-1.0)", r.uint_of_neg_one);
    print_word("uint(1e20)", r.uint_of_large);
    print_word("int(NaN)", r.int_of_nan);
    print_word("7 / 0", r.seven_over_zero);
    print_word("7 % 0", r.seven_mod_zero);
    print_word("1 << 32", r.one_shifted_by_32);
    print_word("read past the end", r.read_past_the_end);
    print_word("NaN < 1", r.nan_less_than_one);
    print_word("NaN >= 1", r.nan_at_least_one);
    print_word("NaN == NaN", r.nan_equals_nan);
    print_word("fma is fused", r.fma_is_fused);
}

TEST(DeviceFacts, table_is_printed) {
    fmt::print("{}, {}\n", test_device().info().name, test_device().info().driver);
    print_floats(facts());
    print_integers(facts());
}

TEST(DeviceFacts, nan_and_inf_are_told_apart) {
    const FactResults& r = facts();
    EXPECT_EQ(r.isnan_of_nan, 1u);
    EXPECT_EQ(r.isnan_of_inf, 0u);
    EXPECT_EQ(r.isnan_of_one, 0u);
    EXPECT_EQ(r.isinf_of_inf, 1u);
    EXPECT_EQ(r.isinf_of_neg_inf, 1u);
    EXPECT_EQ(r.isinf_of_nan, 0u);
    EXPECT_EQ(r.nan_bits_are_nan, 1u);
    EXPECT_EQ(r.inf_bits, 0x7F800000u);
    EXPECT_EQ(r.one_over_neg_zero_times_zero_bits_are_nan, 1u);
}

TEST(DeviceFacts, infinity_compares_as_larger_than_all) {
    const FactResults& r = facts();
    EXPECT_EQ(r.inf_above_huge, 1u);
    EXPECT_EQ(r.neg_inf_below_neg_one, 1u);
    EXPECT_EQ(std::bit_cast<float>(r.min_inf_one), 1.0f);
    EXPECT_EQ(std::bit_cast<float>(r.max_inf_one), std::numeric_limits<float>::infinity());
    EXPECT_EQ(std::bit_cast<float>(r.one_over_zero), std::numeric_limits<float>::infinity());
}

TEST(DeviceFacts, guarded_conversions_and_shifts_are_defined) {
    const FactResults& r = facts();
    EXPECT_EQ(r.guarded_uint_of_nan, 0u);
    EXPECT_EQ(r.guarded_uint_of_neg_one, 0u);
    EXPECT_EQ(r.guarded_uint_of_large, 4294967040u);
    EXPECT_EQ(r.masked_shift, 1u);
}

TEST(DeviceFacts, precise_keeps_rounding_errors) {
    const float sum = 1.0f + 1e-10f;
    EXPECT_EQ(std::bit_cast<float>(facts().precise_sum_error), sum - 1.0f);
}

}  // namespace
}  // namespace voxilux
