#include "film/tonemap.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/colour.h"
#include "support/test_images.h"

using namespace voxilux;

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

}  // namespace

TEST(Srgb, codes_round_trip_exactly) {
    for (int code = 0; code < 256; ++code)
        EXPECT_EQ(srgb_code(linear_from_srgb(static_cast<std::uint8_t>(code))), code) << code;
}

TEST(Srgb, known_points_of_the_standard) {
    EXPECT_EQ(srgb_code(0.0f), 0);
    EXPECT_EQ(srgb_code(1.0f), 255);
    EXPECT_EQ(srgb_code(0.18f), 118);  // 1.055 * 0.18^(1/2.4) - 0.055 = 0.461356, times 255 = 117.6
    EXPECT_EQ(srgb_code(0.5f), 188);   // 0.735357 * 255 = 187.5
    EXPECT_NEAR(gpu::encode_srgb(0.0031308f), 0.04045f,
                1e-5f);  // the two branches meet within the standard's rounding
}

TEST(Srgb, values_outside_the_range_are_clamped) {
    EXPECT_EQ(srgb_code(-1.0f), 0);
    EXPECT_EQ(srgb_code(kNan), 0);
    EXPECT_EQ(srgb_code(-kInfinity), 0);
    EXPECT_EQ(srgb_code(kInfinity), 255);
    EXPECT_EQ(srgb_code(1e30f), 255);
}

TEST(ToneMap, every_hard_value_lands_in_the_unit_interval) {
    for (const ToneMap curve : {ToneMap::plain, ToneMap::filmic}) {
        for (const float x : {0.0f, -0.0f, 1e-45f, 1e-30f, 1e-3f, 1.0f, 7.0f, 65504.0f, 1e20f, 3.4e38f,
                              kInfinity, -1.0f, -1e30f, -kInfinity, kNan}) {
            const float y = tone_map(x, curve);
            EXPECT_TRUE(y >= 0.0f && y <= 1.0f) << x << " gives " << y;
        }
        EXPECT_EQ(tone_map(0.0f, curve), 0.0f);
        EXPECT_EQ(tone_map(kInfinity, curve), 1.0f);
        EXPECT_EQ(tone_map(kNan, curve), 0.0f);
        EXPECT_EQ(tone_map(-kInfinity, curve), 0.0f);
    }
}

TEST(ToneMap, curves_never_fall) {
    for (const ToneMap curve : {ToneMap::plain, ToneMap::filmic}) {
        float last = 0.0f;
        for (float x = 1e-6f; x < 1e6f; x *= 1.01f) {
            const float y = tone_map(x, curve);
            EXPECT_GE(y, last) << x;
            last = y;
        }
        EXPECT_EQ(last, 1.0f);
    }
}

TEST(ToneMap, filmic_matches_the_published_fit) {
    // Narkowicz 2016 at 0.6 x: ((x (2.51 x + 0.03)) / (x (2.43 x + 0.59) + 0.14)) by hand for 0.6 * 1 = 0.6.
    EXPECT_NEAR(tone_map(1.0f, ToneMap::filmic), (0.6 * 1.536) / (0.6 * 2.048 + 0.14), 1e-6);
    EXPECT_NEAR(tone_map(0.18f, ToneMap::filmic), (0.108 * 0.30108) / (0.108 * 0.85244 + 0.14), 1e-6);
}

TEST(ToDisplay, counts_every_value_it_had_to_change) {
    Image image = test::constant_image(4, 2, 0.5f);
    image.channels["R"].pixels = {kNan, kInfinity, -kInfinity, -2.0f, 0.0f, 0.5f, 1.0f, 9.0f};
    const DisplayImage display = to_display(image, {.curve = ToneMap::plain});
    EXPECT_EQ(display.nan, 1u);
    EXPECT_EQ(display.infinite, 2u);
    EXPECT_EQ(display.negative, 1u);
    const std::vector<float>& red = display.image.channels.at("R").pixels;
    EXPECT_EQ(std::vector<float>(red.begin(), red.begin() + 5), (std::vector<float>{0, 1, 0, 0, 0}));
    EXPECT_EQ(red[6], 1.0f);
    EXPECT_EQ(red[7], 1.0f);
    EXPECT_TRUE(display.image.display_referred);
}

TEST(ToDisplay, nan_is_magenta_only_in_debug) {
    Image image = test::constant_image(2, 1, 0.5f);
    image.channels["G"].pixels[1] = kNan;
    const auto pixel = [&](bool debug, std::size_t i) {
        const DisplayImage shown = to_display(image, {.curve = ToneMap::plain, .debug_nan = debug});
        return std::array<int, 3>{srgb_code(shown.image.channels.at("R").pixels[i]),
                                  srgb_code(shown.image.channels.at("G").pixels[i]),
                                  srgb_code(shown.image.channels.at("B").pixels[i])};
    };
    EXPECT_EQ(pixel(true, 1), (std::array<int, 3>{255, 0, 255}));
    EXPECT_EQ(pixel(true, 0), (std::array<int, 3>{188, 188, 188}));
    EXPECT_EQ(pixel(false, 1), (std::array<int, 3>{188, 0, 188}));
}

TEST(ToDisplay, automatic_exposure_shows_the_geometric_mean_as_middle_grey) {
    Image image = test::constant_image(4, 1, 0.0f);
    for (const char* name : {"R", "G", "B"}) {
        std::vector<float>& pixels = image.channels.at(name).pixels;
        pixels = {0.0f, 2e-5f, 8e-5f, std::numeric_limits<float>::infinity()};
    }
    EXPECT_NEAR(automatic_exposure_ev(image), std::log2(0.18f / 4e-5f), 1e-4f);
    const DisplayImage shown =
        to_display(test::constant_image(2, 2, 3e-6f), {.curve = ToneMap::plain, .exposure_ev = {}});
    EXPECT_EQ(srgb_code(shown.image.channels.at("R").pixels[0]), srgb_code(0.18f));
    EXPECT_EQ(automatic_exposure_ev(test::constant_image(2, 2, 0.0f)), 0.0f);
}

TEST(ToDisplay, exposure_is_in_stops_and_extremes_stay_defined) {
    const Image image = test::constant_image(1, 1, 0.25f);
    const auto red = [&](float ev) {
        return to_display(image, {.curve = ToneMap::plain, .exposure_ev = ev})
            .image.channels.at("R")
            .pixels[0];
    };
    EXPECT_EQ(srgb_code(red(1.0f)), 188);  // 0.25 * 2
    EXPECT_EQ(srgb_code(red(2.0f)), 255);
    EXPECT_EQ(red(-1000.0f), 0.0f);
    EXPECT_EQ(red(1000.0f), 1.0f);
    const DisplayImage black = to_display(test::constant_image(1, 1, 0.0f), {.exposure_ev = 1000.0f});
    EXPECT_EQ(black.image.channels.at("R").pixels[0], 0.0f);  // 0 times infinity must not become NaN
}
