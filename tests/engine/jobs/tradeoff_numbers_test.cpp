// The numbers of a price list: slopes, the front, noise and bias, the choice of samples, the cache.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <random>
#include <string>

#include "estimators/metrics.h"
#include "jobs/price_list/difference_map.h"
#include "jobs/price_list/equal_rows.h"
#include "jobs/price_list/error_split.h"
#include "jobs/price_list/reference_cache.h"
#include "jobs/price_list/slope.h"
#include "support/scratch_folder.h"
#include "support/test_images.h"

namespace voxilux {
namespace {

constexpr int kEdge = 64;

std::vector<PricePoint> power_law(double exponent, double scatter, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> noise(0.0, scatter);
    std::vector<PricePoint> points;
    for (int i = 0; i < 6; ++i)
        for (int repeat = 0; repeat < 3; ++repeat)
            points.push_back({0.01 * std::pow(2.0, i),
                              0.3 * std::pow(std::pow(2.0, i), exponent) * std::exp(noise(random))});
    return points;
}

TEST(SlopeFit, finds_the_exponent_of_a_power_law_exactly) {
    const std::optional<Slope> slope = fit_slope(power_law(-0.5, 0.0, 0));
    ASSERT_TRUE(slope);
    EXPECT_NEAR(slope->value, -0.5, 1e-12);
    EXPECT_NEAR(slope->high - slope->low, 0.0, 1e-6);
}

TEST(SlopeFit, interval_holds_the_exponent_in_nineteen_of_twenty_fits) {
    int held = 0;
    for (std::uint32_t seed = 0; seed < 400; ++seed) {
        const Slope slope = *fit_slope(power_law(-0.5, 0.1, seed));
        held += slope.low <= -0.5 && -0.5 <= slope.high ? 1 : 0;
    }
    EXPECT_NEAR(held, 380, 13);  // three deviations of 400 draws
}

// Negative control: the interval of another exponent does not hold it.
TEST(SlopeFit, interval_rejects_another_exponent) {
    int held = 0;
    for (std::uint32_t seed = 0; seed < 100; ++seed) {
        const Slope slope = *fit_slope(power_law(-0.33, 0.1, seed));
        held += slope.low <= -0.5 && -0.5 <= slope.high ? 1 : 0;
    }
    EXPECT_LE(held, 5);
}

TEST(SlopeFit, of_too_few_points_or_equal_times_is_nothing) {
    EXPECT_FALSE(fit_slope(std::vector<PricePoint>{{1.0, 0.1}, {2.0, 0.05}}));
    EXPECT_FALSE(fit_slope(std::vector<PricePoint>{{1.0, 0.1}, {1.0, 0.05}, {1.0, 0.2}}));
    EXPECT_FALSE(fit_slope(std::vector<PricePoint>{{1.0, 0.1}, {2.0, 0.0}, {3.0, -1.0}, {4.0, 0.1}}));
}

TEST(ParetoFront, holds_what_nothing_beats_by_rising_time) {
    const std::vector<PricePoint> points = {{4.0, 0.1}, {1.0, 0.5}, {2.0, 0.6}, {2.0, 0.3},
                                            {2.0, 0.3}, {8.0, 0.1}, {9.0, 0.01}};
    EXPECT_EQ(pareto_front(points), (std::vector<std::size_t>{1, 3, 0, 6}));
}

TEST(ParetoFront, changes_when_a_point_gets_better) {
    std::vector<PricePoint> points = {{1.0, 0.5}, {2.0, 0.6}};
    EXPECT_EQ(pareto_front(points), (std::vector<std::size_t>{0}));
    points[1].error = 0.4;
    EXPECT_EQ(pareto_front(points), (std::vector<std::size_t>{0, 1}));
    EXPECT_TRUE(pareto_front({}).empty());
}

Image flat(float value) {
    return test::constant_image(kEdge, kEdge, value);
}

// Pictures that are `bias` off a radiance of 0.5 and noisy, against a reference that is a little noisy
// itself.
SplitError split(double bias, double noise, double reference_noise, std::uint32_t seed) {
    std::mt19937 random(seed);
    Image reference = flat(0.5f);
    test::add_noise(reference, reference_noise, random);
    std::vector<Image> pictures(3, flat(0.5f + static_cast<float>(bias)));
    for (Image& picture : pictures)
        test::add_noise(picture, noise, random);
    const double square = reference_noise * reference_noise / (0.25 + kRelMseEpsilon);
    return split_error(pictures, reference, {square, square, square});
}

double relative(double difference) {
    return difference / std::sqrt(0.25 + kRelMseEpsilon);
}

TEST(ErrorSplit, tells_bias_from_noise) {
    const SplitError error = split(0.03, 0.08, 0.01, 1);
    EXPECT_NEAR(error.bias, relative(0.03), 0.1 * relative(0.03));
    EXPECT_NEAR(error.noise, relative(0.08), 0.05 * relative(0.08));
    EXPECT_NEAR(error.total, std::hypot(relative(0.03), relative(0.08)), 0.05 * relative(0.08));
    EXPECT_LE(error.bias_low, relative(0.03));
    EXPECT_GE(error.bias_high, relative(0.03));
    EXPECT_GT(error.bias_low, 0.0);
    EXPECT_FALSE(error.is_limited);
}

TEST(ErrorSplit, finds_no_bias_where_there_is_none) {
    int found = 0;
    for (std::uint32_t seed = 0; seed < 40; ++seed)
        found += split(0.0, 0.08, 0.01, seed).bias_low > 0.0 ? 1 : 0;
    EXPECT_LE(found, 3);
}

// Negative control: when the reference's noise is not given, it counts as bias.
TEST(ErrorSplit, takes_unknown_noise_of_the_reference_for_bias) {
    std::mt19937 random(5);
    Image reference = flat(0.5f);
    test::add_noise(reference, 0.05, random);
    std::vector<Image> pictures(3, flat(0.5f));
    for (Image& picture : pictures)
        test::add_noise(picture, 0.05, random);
    EXPECT_GT(split_error(pictures, reference, {}).bias_low, 0.5 * relative(0.05));
}

TEST(ErrorSplit, says_when_the_reference_is_too_noisy) {
    EXPECT_TRUE(split(0.0, 0.02, 0.02, 2).is_limited);
    EXPECT_FALSE(split(0.0, 0.2, 0.02, 2).is_limited);
}

TEST(ErrorSplit, counts_pixels_that_differ_in_a_bit) {
    const Image a = flat(0.5f);
    Image b = a;
    EXPECT_EQ(differing_pixels(a, b), 0u);
    b.channels.at("G").pixels[7] = std::nextafter(0.5f, 1.0f);
    b.channels.at("B").pixels[7] = 0.0f;
    b.channels.at("R").pixels[9] = 0.0f;
    EXPECT_EQ(differing_pixels(a, b), 2u);
}

TEST(DifferenceMap, has_the_documented_colours) {
    EXPECT_EQ(difference_colour(0.0), (std::array<int, 3>{0, 0, 4}));
    EXPECT_EQ(difference_colour(0.001), (std::array<int, 3>{0, 0, 4}));
    EXPECT_EQ(difference_colour(std::pow(10.0, -1.5)), (std::array<int, 3>{183, 55, 121}));
    EXPECT_EQ(difference_colour(1.0), (std::array<int, 3>{252, 253, 191}));
    EXPECT_EQ(difference_colour(50.0), (std::array<int, 3>{252, 253, 191}));
}

Level level_with_relmse(std::uint32_t samples, double error) {
    Level level{.samples = samples};
    level.error.total = error;
    return level;
}

TEST(EqualError, extends_the_last_two_levels) {
    const std::vector<Level> levels = {level_with_relmse(4, 0.2), level_with_relmse(16, 0.1)};
    EXPECT_NEAR(samples_for_error(levels, 0.05), 64.0, 1e-9);
    EXPECT_NEAR(samples_for_error(levels, 0.2), 4.0, 1e-9);
    const std::vector<Level> biased = {level_with_relmse(4, 0.2), level_with_relmse(16, 0.2)};
    EXPECT_GT(samples_for_error(biased, 0.1), 1000.0);
    EXPECT_EQ(samples_for_error({level_with_relmse(16, 0.0)}, 0.1), 16.0);
}

CachedPicture some_picture() {
    std::mt19937 random(3);
    CachedPicture picture{.image = flat(0.5f)};
    test::add_noise(picture.image, 0.1, random);
    picture.facts = {{"samples", 64}};
    return picture;
}

TEST(ReferenceCache, gives_back_what_was_stored) {
    const ScratchFolder folder;
    const CachedPicture stored = some_picture();
    EXPECT_FALSE(load_cached(folder.path() / "sub", "abc", kEdge, kEdge));
    ASSERT_TRUE(store_cached(folder.path() / "sub", "abc", stored));
    const std::optional<CachedPicture> loaded = load_cached(folder.path() / "sub", "abc", kEdge, kEdge);
    ASSERT_TRUE(loaded);
    EXPECT_EQ(differing_pixels(loaded->image, stored.image), 0u);
    EXPECT_EQ(loaded->facts.at("samples"), 64);
}

TEST(ReferenceCache, does_not_trust_another_size_or_name) {
    const ScratchFolder folder;
    ASSERT_TRUE(store_cached(folder.path(), "abc", some_picture()));
    EXPECT_FALSE(load_cached(folder.path(), "abc", kEdge, kEdge - 1));
    std::filesystem::rename(folder.path() / "abc.exr", folder.path() / "def.exr");
    EXPECT_FALSE(load_cached(folder.path(), "def", kEdge, kEdge));
    EXPECT_FALSE(load_cached({}, "def", kEdge, kEdge));
}

TEST(ReferenceCache, does_not_trust_a_damaged_file) {
    const ScratchFolder folder;
    ASSERT_TRUE(store_cached(folder.path(), "abc", some_picture()));
    const std::filesystem::path file = folder.path() / "abc.exr";
    const auto size = std::filesystem::file_size(file);
    int trusted = 0;
    for (std::uintmax_t place = 0; place < size; place += size / 40) {
        std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
        stream.seekg(static_cast<std::streamoff>(place));
        const int before = stream.get();
        stream.seekp(static_cast<std::streamoff>(place));
        stream.put(static_cast<char>(before ^ 0x10));
        stream.close();
        const auto loaded = load_cached(folder.path(), "abc", kEdge, kEdge);
        trusted += loaded && differing_pixels(loaded->image, some_picture().image) != 0 ? 1 : 0;
        std::fstream back(file, std::ios::in | std::ios::out | std::ios::binary);
        back.seekp(static_cast<std::streamoff>(place));
        back.put(static_cast<char>(before));
    }
    EXPECT_EQ(trusted, 0);
    std::filesystem::resize_file(file, size / 2);
    EXPECT_FALSE(load_cached(folder.path(), "abc", kEdge, kEdge));
}

TEST(ReferenceCache, key_depends_on_every_letter) {
    EXPECT_EQ(cache_key("scene 1"), cache_key("scene 1"));
    EXPECT_NE(cache_key("scene 1"), cache_key("scene 2"));
}

}  // namespace
}  // namespace voxilux
