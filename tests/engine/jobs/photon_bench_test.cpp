// The numbers and the rows of `bench photons`.

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "jobs/bench/photon_numbers.h"
#include "jobs/bench/photon_row.h"

namespace voxilux {
namespace {

constexpr double kPhotonRoundings = 1e-6;  // of some floats of order one

Image grey(int width, int height, float value) {
    Image image{.width = width, .height = height};
    image.channels["Y"].pixels.assign(pixel_count(image), value);
    return image;
}

float& at(Image& image, int x, int y) {
    return image.channels["Y"].pixels[static_cast<std::size_t>(y * image.width + x)];
}

TEST(PhotonErrors, mask_leaves_out_a_emitter_and_three_steps_around_it) {
    Image picture = grey(16, 12, 1.0f);
    at(picture, 7, 5) = 5.1f;
    Image mask = emitter_mask(picture);
    for (int y = 0; y < 12; ++y)
        for (int x = 0; x < 16; ++x)
            EXPECT_EQ(at(mask, x, y) == 0.0f, std::abs(x - 7) + std::abs(y - 5) <= 3) << x << " " << y;
}

TEST(PhotonErrors, mask_at_a_corner_stays_inside_and_no_emitter_masks_nothing) {
    Image picture = grey(5, 5, 5.0f);
    Image mask = emitter_mask(picture);
    EXPECT_EQ(std::ranges::count(mask.channels["Y"].pixels, 0.0f), 0);
    at(picture, 4, 4) = 6.0f;
    mask = emitter_mask(picture);
    EXPECT_EQ(std::ranges::count(mask.channels["Y"].pixels, 0.0f), 10);  // 4 + 3 + 2 + 1
}

// A Gaussian of 2 pixels has the sum of squares 1 / (4 pi 2^2) over all pixels.
TEST(PhotonErrors, blurred_difference_of_a_point_is_a_gaussian) {
    const Image reference = grey(64, 64, 1.0f);
    Image test = reference;
    at(test, 32, 32) = 2.0f;
    const double squares = std::pow(blurred_rmse(reference, test, {0, 0, 64, 64}), 2.0) * 64.0 * 64.0;
    EXPECT_NEAR(squares * 16.0 * std::acos(-1.0), 1.0, 1e-3);  // what is cut at four deviations
    EXPECT_LT(blurred_rmse(reference, test, {0, 0, 16, 16}), 1e-9) << "the point is far from the box";
}

TEST(PhotonErrors, blur_keeps_what_is_equal_everywhere_up_to_the_border) {
    const Image reference = grey(9, 7, 1.0f), test = grey(9, 7, 1.5f);
    EXPECT_NEAR(blurred_rmse(reference, test, {0, 0, 9, 7}), 0.5, kPhotonRoundings);
    EXPECT_NEAR(blurred_rmse(reference, test, {0, 0, 1, 1}), 0.5, kPhotonRoundings);
}

TEST(PhotonErrors, emitters_count_for_nothing_and_other_pixels_as_relmse) {
    Image reference = grey(20, 20, 1.0f);
    at(reference, 0, 0) = 9.0f;
    Image test = grey(20, 20, 1.1f);
    at(test, 0, 0) = 400.0f;
    const PhotonErrors errors = photon_errors(reference, test, std::nullopt);
    EXPECT_NEAR(errors.relmse, 0.01 / 1.01, kPhotonRoundings);
    EXPECT_NEAR(errors.bias[1], 0.1, kPhotonRoundings);
    EXPECT_FALSE(errors.floor);
    at(test, 19, 19) = 2.0f;
    EXPECT_GT(photon_errors(reference, test, std::nullopt).relmse, errors.relmse);
}

TEST(PhotonErrors, box_outside_and_other_sizes_are_refused) {
    const Image reference = grey(8, 8, 1.0f);
    EXPECT_THROW((void)photon_errors(reference, reference, PixelBox{0, 0, 9, 8}), Error);
    EXPECT_THROW((void)photon_errors(reference, grey(9, 8, 1.0f), std::nullopt), Error);
}

PhotonRow row_of(std::uint32_t photons, double wall_s) {
    return {.scene = "a.toml",
            .series = "photons",
            .variant = {.name = "gather"},
            .photons = photons,
            .size = {8, 4},
            .iterations = 2,
            .radius = 2.0,
            .wall_s = wall_s,
            .passes_ms = {{"photon.trace", 10.0 * wall_s}, {"film.add", 8.0 / wall_s}}};
}

TEST(PhotonRow, rate_counts_the_photons_of_all_iterations) {
    EXPECT_EQ(row_of(1000, 0.5).photons_per_s(), 4000.0);
}

TEST(PhotonRow, growth_is_that_of_time_over_what_is_varied) {
    const std::vector<PhotonRow> rows = {row_of(1000, 1.0), row_of(2000, 2.0), row_of(4000, 4.0)};
    const PhotonGrowth growth = growth_of(rows);
    EXPECT_NEAR(growth.wall.value(), 1.0, 1e-12);
    EXPECT_NEAR(growth.passes.at("photon.trace"), 1.0, 1e-12);
    EXPECT_NEAR(growth.passes.at("film.add"), -1.0, 1e-12);
    const std::string text = describe(rows);
    EXPECT_NE(text.find("exponent  of photons: wall 1.00, film.add -1.00, photon.trace 1.00"),
              std::string::npos)
        << text;
}

TEST(PhotonRow, faults_are_named_below_the_row) {
    PhotonRow row = row_of(1000, 1.0);
    EXPECT_EQ(describe(std::vector{row}).find("faults"), std::string::npos);
    row.faults = 3;
    EXPECT_NE(describe(std::vector{row}).find("3 faults: the picture is wrong"), std::string::npos);
}

TEST(PhotonRow, options_have_no_growth) {
    std::vector<PhotonRow> rows = {row_of(1000, 1.0), row_of(1000, 2.0)};
    for (PhotonRow& row : rows)
        row.series = "options";
    EXPECT_FALSE(growth_of(rows).wall);
    EXPECT_EQ(describe(rows).find("exponent"), std::string::npos);
}

TEST(PhotonVariants, first_is_the_default_and_the_others_change_one_option) {
    EXPECT_EQ(settings_of(photon_variants().front(), {}), PhotonSettings{});
    for (const PhotonVariant& variant : photon_variants())
        EXPECT_EQ(variant.scatter + variant.classic + !variant.roulette, variant.name == "gather" ? 0 : 1);
    EXPECT_EQ(iterations_of({.slowness = 16}, 64), 4u);
    EXPECT_EQ(iterations_of({.slowness = 16}, 8), 1u);
}

TEST(PhotonVariants, name_picks_one_and_an_unknown_one_is_refused) {
    EXPECT_TRUE(photon_variant_named("classic").classic);
    EXPECT_FALSE(photon_variant_named("gather").classic);
    EXPECT_THROW((void)photon_variant_named("gathr"), Error);
}

}  // namespace
}  // namespace voxilux
