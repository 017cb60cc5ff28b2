// The estimated error of a denoised picture, from estimates of its pixels.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "estimators/denoised_error.h"
#include "support/statistics.h"

namespace voxilux {
namespace {

constexpr int kWidth = 64, kHeight = 48;

// Estimates of relMSE around `mean`, distributed like the product of the noises of two halves.
std::vector<float> noisy_estimates(double mean, double noise, std::uint64_t seed) {
    test::TestRandom random(seed);
    std::vector<float> values(kWidth * kHeight);
    for (float& value : values)
        value = static_cast<float>(mean + noise * random.uniform(-1.0, 1.0) * random.uniform(-1.0, 1.0));
    return values;
}

TEST(DenoisedError, interval_holds_the_mean_in_95_of_100_pictures) {
    int covered = 0, covered_by_half = 0;
    constexpr int kPictures = 400;
    for (std::uint64_t seed = 1; seed <= kPictures; ++seed) {
        const std::vector<float> values = noisy_estimates(0.01, 1.0, seed);
        const ErrorEstimate error =
            denoised_error(kWidth, kHeight, values, std::vector<float>(values.size(), 0.0f));
        const auto holds = [&](double low, double high) { return low <= 0.1 && 0.1 <= high ? 1 : 0; };
        covered += holds(error.low, error.high);
        covered_by_half += holds(0.5 * (error.low + error.estimate), 0.5 * (error.estimate + error.high));
    }
    EXPECT_GE(covered, kPictures * 95 / 100);
    EXPECT_LT(covered_by_half, kPictures * 95 / 100) << "the negative control: half the width";
}

TEST(DenoisedError, is_the_variance_at_least) {
    const std::vector<float> none = noisy_estimates(-0.001, 0.0, 1), variance(none.size(), 0.04f);
    const ErrorEstimate error = denoised_error(kWidth, kHeight, none, variance);
    EXPECT_NEAR(error.estimate, 0.2, 1e-6);
    EXPECT_EQ(error.low, 0.0);
    EXPECT_NEAR(error.high, 0.2, 1e-6);
}

TEST(DenoisedError, few_pixels_have_no_upper_end) {
    const std::vector<float> few(16, 0.01f);
    const ErrorEstimate error = denoised_error(4, 4, few, few);
    EXPECT_TRUE(std::isinf(error.high));
    EXPECT_NEAR(error.estimate, 0.1, 1e-6);
}

}  // namespace
}  // namespace voxilux
