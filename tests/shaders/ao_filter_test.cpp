// Weights of the a-trous filter of visibility.

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <vector>

#include "shared/ao_filter.h"
#include "support/statistics.h"

namespace voxilux {
namespace {

using test::TestRandom;

const std::vector<float> kTaken{0.0f, 1.0f, 2.0f, 100.0f, 65536.0f, 0x1p24f, 0x1p32f, 0x1p53f, 0x1p64f};

TEST(AoFilter, spline_is_the_binomial_row) {
    EXPECT_EQ((std::array{gpu::spline_weight(-2), gpu::spline_weight(-1), gpu::spline_weight(0),
                          gpu::spline_weight(1), gpu::spline_weight(2)}),
              (std::array{1.0f, 4.0f, 6.0f, 4.0f, 1.0f}));
}

TEST(AoFilter, plane_weight_is_in_the_unit_interval_and_falls_to_0_at_the_footprint) {
    for (const float footprint : {0.0f, 1e-30f, 0.001f, 1.0f, 1e6f, 1e30f}) {
        EXPECT_EQ(gpu::plane_weight(0.0f, footprint), 1.0f);
        for (const float height : {1e-30f, 0.0005f, 0.5f, 1.0f, 1e6f, 1e30f}) {
            const float weight = gpu::plane_weight(height, footprint);
            EXPECT_TRUE(weight >= 0.0f && weight <= 1.0f) << height << " " << footprint << " " << weight;
            EXPECT_EQ(weight, gpu::plane_weight(-height, footprint));
            EXPECT_TRUE(weight == 0.0f || height < footprint) << height << " " << footprint;
        }
    }
    EXPECT_EQ(gpu::plane_weight(0.25f, 1.0f), 0.75f);
}

TEST(AoFilter, variance_is_that_of_the_share_after_one_more_success_and_failure) {
    for (const double taken : {1.0, 7.0, 500.0, 65536.0}) {
        for (const double visibility : {0.0, 0.25, 0.5, 1.0}) {
            const double p = (visibility * taken + 1.0) / (taken + 2.0);
            const float got =
                gpu::visibility_variance(static_cast<float>(visibility), static_cast<float>(taken));
            EXPECT_NEAR(static_cast<double>(got) / (p * (1.0 - p) / taken), 1.0, 1e-4)
                << visibility << " of " << taken;
        }
    }
}

TEST(AoFilter, variance_is_finite_and_not_negative_for_any_number_of_samples) {
    for (const float taken : kTaken) {
        for (const float visibility : {0.0f, 0x1p-30f, 0.5f, 0x1.fffffep-1f, 1.0f}) {
            const float variance = gpu::visibility_variance(visibility, taken);
            EXPECT_TRUE(variance >= 0.0f && variance <= 0.25f)
                << visibility << " of " << taken << ": " << variance;
        }
    }
}

TEST(AoFilter, value_weight_is_in_the_unit_interval_for_any_number_of_samples) {
    for (const float taken : kTaken) {
        for (const float visibility : {0.0f, 0.3f, 1.0f}) {
            const float variance = gpu::visibility_variance(visibility, taken);
            for (const float difference : {0.0f, 0x1p-40f, 0x1p-24f, 0.01f, 1.0f, -0.5f, -1.0f}) {
                const float weight = gpu::value_weight(difference, variance);
                EXPECT_TRUE(weight >= 0.0f && weight <= 1.0f)
                    << difference << " from " << visibility << " of " << taken << ": " << weight;
            }
            EXPECT_EQ(gpu::value_weight(0.0f, variance), 1.0f) << visibility << " of " << taken;
        }
    }
    EXPECT_EQ(gpu::value_weight(1.0f, 0.01f), 0.0f);
    EXPECT_FLOAT_EQ(gpu::value_weight(0.2f, 0.01f), 0.5f) << "two of four standard deviations";
}

struct Tap {
    float visibility;
    float taken;
    float height;
};

// Filters one pixel over 25 taps, of which the 12th is its own, as the pass does.
float filtered(const std::array<Tap, 25>& taps, float footprint) {
    const Tap& centre = taps[12];
    const float variance = gpu::visibility_variance(centre.visibility, centre.taken);
    float sum = 36.0f * centre.visibility;
    float weights = 36.0f;
    for (int i = 0; i < 25; ++i) {
        if (i == 12) continue;
        const Tap& tap = taps[static_cast<std::size_t>(i)];
        const float weight = gpu::spline_weight(i % 5 - 2) * gpu::spline_weight(i / 5 - 2) *
                             gpu::plane_weight(tap.height, footprint) *
                             gpu::value_weight(tap.visibility - centre.visibility, variance);
        sum += weight * tap.visibility;
        weights += weight;
    }
    return sum / weights;
}

TEST(AoFilter, constant_stays_constant) {
    for (const float value : {0.0f, 0.3f, 0.5f, 1.0f}) {
        for (const float taken : kTaken) {
            std::array<Tap, 25> taps{};
            taps.fill({value, taken, 0.0f});
            EXPECT_NEAR(filtered(taps, 0.0f), value, 4e-7f * value) << taken;
        }
    }
    std::array<Tap, 25> open{};
    open.fill({1.0f, 9.0f, 0.0f});
    EXPECT_EQ(filtered(open, 1.0f), 1.0f);
}

TEST(AoFilter, result_is_between_its_taps) {
    TestRandom random(2);
    for (int i = 0; i < 20000; ++i) {
        std::array<Tap, 25> taps{};
        float low = 1.0f;
        float high = 0.0f;
        for (Tap& tap : taps) {
            const auto choice = static_cast<std::size_t>(random.bits64() % kTaken.size());
            tap = {static_cast<float>(random.uniform(0.0, 1.0)), kTaken[choice],
                   static_cast<float>(random.uniform(-1.0, 1.0))};
            if (random.bits64() % 4 == 0) tap.visibility = std::round(tap.visibility);
            low = std::min(low, tap.visibility);
            high = std::max(high, tap.visibility);
        }
        const float value = filtered(taps, i % 3 == 0 ? 0.0f : 1.5f);
        ASSERT_TRUE(value >= low * (1.0f - 1e-6f) && value <= high * (1.0f + 1e-6f)) << value;
    }
}

// Values from many samples are kept; values from few are smoothed.
TEST(AoFilter, smoothing_fades_with_the_number_of_samples) {
    float last = 0.0f;
    for (const float taken : {1.0f, 16.0f, 256.0f, 4096.0f}) {
        std::array<Tap, 25> taps{};
        taps.fill({0.5f, taken, 0.0f});
        taps[12].visibility = 0.75f;
        const float kept = filtered(taps, 1.0f) - 0.5f;
        EXPECT_GE(kept, last) << taken;
        last = kept;
    }
    EXPECT_EQ(last, 0.25f);
}

}  // namespace
}  // namespace voxilux
