#include "estimators/metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/statistics.h"
#include "support/test_images.h"

using namespace voxilux;

namespace {

Metrics measure(const Image& reference, const Image& test, const Selection& selection = {}) {
    return measure_difference(reference, test, selected_pixels(reference.width, reference.height, selection));
}

// Relative: sums of a few thousand doubles that are exact up to one rounding each.
constexpr double kRelative = 1e-14;

void expect_close(double value, double expected) {
    EXPECT_NEAR(value, expected, kRelative * std::abs(expected)) << value << " against " << expected;
}

std::string refusal(const std::function<void()>& action) {
    try {
        action();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::input_refused);
        return error.what();
    }
    return "not refused";
}

}  // namespace

TEST(Metrics, constant_images_match_the_closed_forms) {
    const Metrics m = measure(test::constant_image(17, 9, 0.5f), test::constant_image(17, 9, 0.75f));
    expect_close(m.rmse, 0.25);
    expect_close(m.mae, 0.25);
    expect_close(m.relmse, 0.0625 / 0.26);
    expect_close(m.trimmed_relmse, 0.0625 / 0.26);
    expect_close(m.smape, 0.5 / 1.26);
    expect_close(*m.psnr, 20.0 * std::log10(4.0));
    expect_close(m.max_abs, 0.25);
    EXPECT_EQ(m.mean_ref, (std::array<double, 3>{0.5, 0.5, 0.5}));
    EXPECT_EQ(m.mean_test, (std::array<double, 3>{0.75, 0.75, 0.75}));
    EXPECT_EQ(m.pixels, 17u * 9u);
}

TEST(Metrics, linear_ramp_matches_the_sums_of_powers) {
    // x - r = i / 256 for i = 0 .. n-1 in every channel, r = 0: sum i = n(n-1)/2, sum i^2 = (n-1)n(2n-1)/6.
    constexpr int kWidth = 64, kHeight = 32, n = kWidth * kHeight;
    const Image test = test::rgb_image(
        kWidth, kHeight, [](int x, int y, int) { return static_cast<float>(y * kWidth + x) / 256.0f; });
    const Metrics m = measure(test::constant_image(kWidth, kHeight, 0.0f), test);
    const double squares = (n - 1.0) * n * (2.0 * n - 1.0) / 6.0 / (256.0 * 256.0);
    expect_close(m.rmse, std::sqrt(squares / n));
    expect_close(m.mae, (n - 1.0) / 2.0 / 256.0);
    expect_close(m.relmse, squares / n / 0.01);
    expect_close(m.max_abs, (n - 1.0) / 256.0);
}

TEST(Metrics, equal_images_have_no_error_and_infinite_psnr) {
    const Image image = test::noise_image(20, 20, 3);
    const Metrics m = measure(image, image);
    EXPECT_EQ(m.rmse, 0.0);
    EXPECT_EQ(m.relmse, 0.0);
    EXPECT_EQ(m.smape, 0.0);
    EXPECT_FALSE(m.psnr.has_value());
}

TEST(Metrics, one_perturbed_value_shows_in_every_metric) {  // negative control of the case above
    const Image image = test::noise_image(20, 20, 3);
    Image other = image;
    other.channels["G"].pixels[210] += 1e-3f;
    const Metrics m = measure(image, other);
    EXPECT_GT(m.rmse, 0.0);
    EXPECT_GT(m.mae, 0.0);
    EXPECT_GT(m.relmse, 0.0);
    EXPECT_GT(m.smape, 0.0);
    EXPECT_GT(m.max_abs, 0.0);
    EXPECT_TRUE(m.psnr.has_value());
}

TEST(Metrics, trimmed_relmse_ignores_the_worst_pixel_in_a_thousand) {
    Image reference = test::constant_image(50, 40, 1.0f);
    Image test = test::constant_image(50, 40, 1.1f);
    for (auto& [name, channel] : test.channels) {
        channel.pixels[7] = 1e6f;
        channel.pixels[1234] = 1e5f;
    }
    const Metrics m = measure(reference, test);
    EXPECT_GT(m.relmse, 1e8);
    const double difference = static_cast<double>(1.1f) - 1.0;
    expect_close(m.trimmed_relmse, difference * difference / 1.01);
}

TEST(Metrics, grey_image_counts_as_three_equal_channels) {
    Image grey{.width = 4, .height = 4};
    grey.channels["Y"].pixels.assign(16, 0.25f);
    expect_close(measure(test::constant_image(4, 4, 0.5f), grey).mae, 0.25);
}

TEST(Metrics, box_and_mask_select_pixels) {
    const Image zero = test::constant_image(10, 10, 0.0f);
    const Image test =
        test::rgb_image(10, 10, [](int x, int y, int) { return x >= 5 && y >= 5 ? 1.0f : 0.0f; });
    EXPECT_EQ(measure(zero, test, {.box = PixelBox{5, 5, 10, 10}}).mae, 1.0);
    EXPECT_EQ(measure(zero, test, {.box = PixelBox{0, 0, 5, 10}}).mae, 0.0);
    EXPECT_EQ(measure(zero, test, {.mask = &test}).mae, 1.0);
    EXPECT_EQ(measure(zero, test, {.mask = &test}).pixels, 25u);
    EXPECT_EQ(measure(zero, test, {.box = PixelBox{4, 4, 6, 6}, .mask = &test}).pixels, 1u);
    EXPECT_EQ(measure(zero, test).mae, 0.25);
}

TEST(Metrics, image_without_colours_is_refused_with_what_it_has) {
    const std::vector<std::string> rgb{"R", "G", "B"}, layer{"BG.R", "BG.G", "BG.B\x1b"};
    const Image image = make_image(2, 2, rgb);
    const std::string words = refusal([&] { measure(image, make_image(2, 2, layer)); });
    EXPECT_NE(words.find("'BG.R'"), std::string::npos) << words;
    EXPECT_EQ(words.find('\x1b'), std::string::npos) << words;
    EXPECT_NE(refusal([&] { measure(make_image(2, 2, {}), image); }).find("none at all"), std::string::npos);
}

TEST(Metrics, bad_selections_are_refused) {
    const Image image = test::constant_image(10, 10, 0.0f);
    const Image small = test::constant_image(9, 10, 1.0f);
    EXPECT_NE(refusal([&] {
                  measure(image, image, {.box = PixelBox{0, 0, 11, 10}});
              }).find("10x10"),
              std::string::npos);
    EXPECT_NE(refusal([&] {
                  measure(image, image, {.box = PixelBox{5, 5, 5, 6}});
              }).find("empty"),
              std::string::npos);
    EXPECT_NE(refusal([&] { measure(image, image, {.mask = &small}); }).find("9x10"), std::string::npos);
    EXPECT_NE(refusal([&] { measure(image, image, {.mask = &image}); }).find("no pixel"), std::string::npos);
    EXPECT_NE(refusal([&] { measure(image, small); }).find("9x10"), std::string::npos);
}

TEST(Metrics, non_finite_pixel_makes_every_metric_nan) {
    const Image image = test::constant_image(5, 5, 1.0f);
    for (const float bad :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        Image other = image;
        other.channels["R"].pixels[12] = bad;
        const Metrics m = measure(image, other);
        EXPECT_EQ(m.non_finite, 1u);
        EXPECT_TRUE(std::isnan(m.rmse) && std::isnan(m.max_abs) && std::isnan(m.relmse));
    }
}

TEST(CompensatedSum, tiny_terms_survive_beside_a_huge_one) {
    CompensatedSum sum;
    double plain = 1e16;
    sum.add(1e16);
    for (int i = 0; i < 1000; ++i) {
        sum.add(1.0);
        plain += 1.0;
    }
    sum.add(-1e16);
    EXPECT_EQ(sum.value(), 1000.0);
    EXPECT_NE(plain - 1e16, 1000.0);  // negative control: a plain sum loses them
}
