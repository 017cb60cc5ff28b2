#include "shared/halton.h"

#include <array>
#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>

namespace voxilux {
namespace {

constexpr std::array<std::uint32_t, 12> kPrimes = {2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37};

// floor(2^24 radical inverse) from digits collected in 64 bits.
std::uint64_t radical_inverse_24_wide(std::uint64_t index, std::uint64_t base) {
    std::uint64_t mirrored = 0;
    std::uint64_t power = 1;
    for (; index > 0; index /= base) {
        mirrored = mirrored * base + index % base;
        power *= base;
    }
    return (mirrored << 24) / power;
}

// Distance of a and b on the unit circle, in units of 2^-24.
std::uint32_t rotation_between(float a, float b) {
    const auto fixed = [](float v) { return static_cast<std::uint32_t>(v * 0x1p24f); };
    return (fixed(a) - fixed(b)) & 0xFFFFFFu;
}

TEST(Halton, bases_are_the_first_primes) {
    for (std::uint32_t d = 0; d < gpu::kHaltonDimensions; ++d)
        EXPECT_EQ(gpu::halton_base(d), kPrimes[d]);
}

TEST(Halton, radical_inverse_equals_wide_integers_for_every_index_and_base) {
    for (const std::uint32_t base : kPrimes) {
        for (std::uint32_t index = 0; index <= gpu::kHaltonPeriod; ++index)
            ASSERT_EQ(gpu::radical_inverse_24(index, base), radical_inverse_24_wide(index, base))
                << "index " << index << " base " << base;
    }
}

TEST(Halton, every_value_is_one_fixed_rotation_of_the_radical_inverse_of_frame_plus_one) {
    for (std::uint32_t d = 0; d < gpu::kHaltonDimensions; ++d) {
        const std::uint32_t rotation =
            rotation_between(gpu::halton_float(5, 77, 0, d),
                             static_cast<float>(radical_inverse_24_wide(1, kPrimes[d])) * 0x1p-24f);
        for (std::uint32_t frame = 1; frame < gpu::kHaltonPeriod; ++frame) {
            const float value = gpu::halton_float(5, 77, frame, d);
            const float inverse =
                static_cast<float>(radical_inverse_24_wide(frame + 1, kPrimes[d])) * 0x1p-24f;
            ASSERT_GE(value, 0.0f);
            ASSERT_LT(value, 1.0f);
            ASSERT_EQ(rotation_between(value, inverse), rotation) << "frame " << frame << " dimension " << d;
        }
    }
}

TEST(Halton, rotations_differ_between_streams_dimensions_and_seeds) {
    EXPECT_NE(gpu::halton_float(0, 1, 0, 0), gpu::halton_float(0, 2, 0, 0));
    EXPECT_NE(gpu::halton_float(0, 1, 0, 0), gpu::halton_float(1, 1, 0, 0));
    EXPECT_NE(rotation_between(gpu::halton_float(0, 1, 0, 0), 0.5f),
              rotation_between(gpu::halton_float(0, 1, 0, 1), 1.0f / 3.0f));
}

TEST(Halton, repeats_after_its_period_and_white_dimensions_do_not) {
    EXPECT_EQ(gpu::halton_float(0, 9, 3, 4), gpu::halton_float(0, 9, 3 + gpu::kHaltonPeriod, 4));
    EXPECT_NE(gpu::halton_float(0, 9, 3, 12), gpu::halton_float(0, 9, 3 + gpu::kHaltonPeriod, 12));
    EXPECT_EQ(gpu::halton_float(0, 9, 3, 12), gpu::rng_float(0, 9, 3, 12));
}

}  // namespace
}  // namespace voxilux
