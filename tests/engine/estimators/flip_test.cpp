// Truth: the package flip-evaluator 1.7 by the authors of FLIP, run once on the very images that these tests
// make from integer hashes; the constants are the double-precision means of the error maps it returned.

#include "estimators/flip.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

#include "support/test_images.h"

using namespace voxilux;
using test::hash32;

namespace {

// Mean FLIP, absolute: the package works in float, we in double; 7e-5 is the worst of 56 pairs, at 1x1
// pixels.
constexpr double kFlipTolerance = 1e-4;

double mean_of(const std::optional<FlipResult>& result) {
    EXPECT_TRUE(result.has_value());
    std::vector<std::size_t> pixels(result ? result->error.size() : 0);
    std::iota(pixels.begin(), pixels.end(), std::size_t{0});
    return result ? mean_flip(*result, pixels) : std::nan("");
}

Image checker(int shift) {
    return test::code_image(64, 48, [=](int x, int y, int c) {
        const bool is_light = ((x + shift) / 8 + y / 8) % 2 != 0;
        return static_cast<std::uint32_t>(is_light ? 200 - 40 * c : 30 + 20 * c);
    });
}

std::uint32_t index_of(int x, int y, int c) {
    return static_cast<std::uint32_t>((y * 40 + x) * 3 + c);
}

float hdr_value(int x, int y, int c) {
    const std::uint32_t n = hash32(index_of(x, y, c));
    return std::ldexp(static_cast<float>((n & 255u) + 1u), static_cast<int>((n >> 8) & 7u) - 10);
}

Image hdr_noise() {
    return test::rgb_image(40, 30, hdr_value);
}

Image hdr_noise_brightened() {
    return test::rgb_image(40, 30, [](int x, int y, int c) {
        const std::uint32_t n = hash32(index_of(x, y, c) + 1000000u) & 63u;
        return hdr_value(x, y, c) * (1.0f + static_cast<float>(n) / 256.0f);
    });
}

Image ramp() {
    return test::rgb_image(
        48, 40, [](int x, int y, int c) { return static_cast<float>((x + 1) * (y + 2 + c)) / 64; });
}

}  // namespace

TEST(Flip, ldr_noise_matches_the_authors_program) {
    EXPECT_NEAR(mean_of(ldr_flip(test::noise_image(40, 30, 0), test::noise_image(40, 30, 1000000))),
                0.4389509281, kFlipTolerance);
}

TEST(Flip, ldr_shifted_checker_matches_the_authors_program) {
    EXPECT_NEAR(mean_of(ldr_flip(checker(0), checker(1))), 0.2385641751, kFlipTolerance);
}

TEST(Flip, image_smaller_than_the_filters_matches_the_authors_program) {
    EXPECT_NEAR(mean_of(ldr_flip(test::noise_image(3, 2, 0), test::noise_image(3, 2, 1000000))), 0.5523451120,
                kFlipTolerance);
}

TEST(Flip, hdr_noise_matches_the_authors_program) {
    const Image reference = hdr_noise();
    const auto result = hdr_flip(reference, hdr_noise_brightened());
    EXPECT_NEAR(mean_of(result), 0.1140537527, kFlipTolerance);
    EXPECT_EQ(result->exposures, 4);
    const auto exposures = flip_exposures(reference);
    EXPECT_NEAR(exposures->start, -3.708925247, 1e-5);  // stops; the package keeps luminance in float
    EXPECT_NEAR(exposures->stop, -0.043081168, 1e-5);
}

TEST(Flip, hdr_firefly_matches_the_authors_program) {
    Image test = ramp();
    for (auto& [name, channel] : test.channels)
        channel.pixels[20 * 48 + 24] = 100.0f;
    const auto result = hdr_flip(ramp(), test);
    EXPECT_NEAR(mean_of(result), 0.0012453071, kFlipTolerance);
    EXPECT_EQ(result->exposures, 3);
}

TEST(Flip,
     one_changed_code_in_the_input_leaves_the_frozen_value) {  // negative control of the comparisons above
    Image test = test::noise_image(40, 30, 1000000);
    for (std::size_t i = 0; i < 40; ++i)
        test.channels["G"].pixels[i] = 0.0f;
    EXPECT_GT(std::abs(mean_of(ldr_flip(test::noise_image(40, 30, 0), test)) - 0.4389509281),
              2 * kFlipTolerance);
}

TEST(Flip, equal_images_give_zero_everywhere) {
    const Image image = test::noise_image(33, 17, 5);
    const Image hdr = hdr_noise();
    for (const auto& result : {ldr_flip(image, image), hdr_flip(hdr, hdr)}) {
        for (const float error : result->error)
            EXPECT_EQ(error, 0.0f);
    }
}

TEST(Flip, black_against_white_is_nearly_one) {
    const auto result = ldr_flip(test::constant_image(8, 8, 0.0f), test::constant_image(8, 8, 1.0f));
    EXPECT_NEAR(mean_of(result), 0.96738821, kFlipTolerance);  // the package's value for 8x8
}

TEST(Flip, error_map_stays_in_the_unit_interval) {
    const auto result = hdr_flip(hdr_noise(), test::constant_image(40, 30, 1e30f));
    for (const float error : result->error) {
        EXPECT_GE(error, 0.0f);
        EXPECT_LE(error, 1.0f);
    }
}

TEST(Flip, undefined_inputs_give_no_value) {
    const Image good = test::constant_image(4, 4, 0.5f);
    Image bad = good;
    bad.channels["B"].pixels[3] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_FALSE(ldr_flip(good, bad).has_value());
    EXPECT_FALSE(hdr_flip(bad, good).has_value());
    EXPECT_FALSE(
        hdr_flip(test::constant_image(4, 4, 0.0f), good).has_value());  // no exposure shows a black picture
    Image colourless = good;
    colourless.channels.erase("G");
    EXPECT_FALSE(ldr_flip(good, colourless).has_value());
}

TEST(Flip, kind_follows_the_images) {
    const Image ldr = test::noise_image(8, 8, 1);
    const Image hdr = test::constant_image(8, 8, 2.0f);
    EXPECT_EQ(flip(ldr, ldr)->exposures, 0);
    EXPECT_GT(flip(ldr, hdr)->exposures, 0);
    EXPECT_GT(flip(hdr, hdr)->exposures, 0);
}
