#include "estimators/error_estimate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>

#include "estimators/metrics.h"
#include "film/film.h"
#include "shared/film_sum.h"
#include "support/interval_coverage.h"
#include "support/test_images.h"

using namespace voxilux;

namespace {

// A number in the film's format, rounded to nearest.
std::int64_t fixed(double value) {
    return std::llround(std::ldexp(value, kFilmFractionBits));
}

using test::NoiseKind;

struct Noise {
    NoiseKind kind = NoiseKind::gauss;
    int width = 32, height = 24;
    std::uint64_t na = 32, nb = 32;
};

void PrintTo(const Noise& noise, std::ostream* out) {
    *out << test::name_of(noise.kind) << ' ' << noise.width << 'x' << noise.height << ", " << noise.na
         << " and " << noise.nb << " samples";
}

// Two halves around a known picture.
struct Trial {
    std::vector<std::int64_t> a, b;
    std::vector<double> truth;  // [height][width][3]
    std::vector<std::uint64_t> na, nb;

    [[nodiscard]] FilmHalf half_a() const { return {a, na}; }
    [[nodiscard]] FilmHalf half_b() const { return {b, nb}; }
};

using Random = std::mt19937_64;

// The sum of n samples of mean 1.
double sum_of_samples(NoiseKind kind, std::uint64_t n, double sigma, Random& random) {
    const double count = static_cast<double>(n);
    const auto events = [&](double p) {
        return static_cast<double>(std::binomial_distribution<std::uint64_t>(n, p)(random));
    };
    switch (kind) {
        case NoiseKind::gauss:
            return count + std::sqrt(count) * sigma * std::normal_distribution<double>()(random);
        case NoiseKind::ambient_occlusion:  // rays that escape or do not
            return events(0.6) / 0.6;
        case NoiseKind::firefly:  // one sample in a hundred is 61 times as bright as the rest
            return (count + 60.0 * events(0.01)) / 1.6;
        case NoiseKind::decay:  // exponential
            return std::gamma_distribution<double>(count, 1.0)(random);
    }
    return 0.0;
}

// Radiance rises from left to right by a factor of 20; the upper half is quiet where the noise is Gaussian.
Trial make_trial(const Noise& noise, Random& random) {
    Trial trial{.na = {noise.na}, .nb = {noise.nb}};
    for (int y = 0; y < noise.height; ++y) {
        for (int x = 0; x < noise.width; ++x) {
            const double brightness = 0.1 + 2.0 * x / noise.width;
            const double sigma = y < noise.height / 2 ? 0.2 : 0.7;
            const double a = brightness * sum_of_samples(noise.kind, noise.na, sigma, random);
            const double b = brightness * sum_of_samples(noise.kind, noise.nb, sigma, random);
            for (int c = 0; c < 3; ++c) {
                trial.truth.push_back(brightness);
                trial.a.push_back(fixed(a));
                trial.b.push_back(fixed(b));
            }
        }
    }
    return trial;
}

double true_error(const Trial& trial) {
    double sum = 0.0;
    for (std::size_t i = 0; i < trial.truth.size(); ++i) {
        const double n = static_cast<double>(trial.na[0] + trial.nb[0]);
        const double mean = static_cast<double>(trial.a[i] + trial.b[i]) / n / (1 << kFilmFractionBits);
        const double d = mean - trial.truth[i];
        sum += d * d / (trial.truth[i] * trial.truth[i] + kRelMseEpsilon);
    }
    return std::sqrt(sum / static_cast<double>(trial.truth.size()));
}

ErrorEstimate estimate_of(const Noise& noise, const Trial& trial) {
    return estimate_error(noise.width, noise.height, trial.half_a(), trial.half_b());
}

TEST(Film, mean_of_a_million_samples_is_exact_to_the_last_bit) {
    constexpr std::uint32_t kSamples = 1u << 20;
    gpu::uvec2 words(0u);
    long double exact = 0.0L;  // 64 bits of mantissa: 2^20 terms below 2^8 with 24 fraction bits need 52
    float plain = 0.0f;
    for (std::uint32_t i = 0; i < kSamples; ++i) {
        // A float of 24 bits between 2^-24 and 2^8: the format holds it exactly.
        const std::uint32_t hash = test::hash32(i);
        const float sample = std::ldexp(static_cast<float>(hash >> 16), static_cast<int>(hash % 17) - 24);
        words = gpu::film_add(words, gpu::film_fixed(sample).sum);
        exact += static_cast<long double>(sample);
        plain += sample;
    }
    std::int64_t sum = 0;
    std::memcpy(&sum, &words, sizeof sum);  // as the read-back does
    EXPECT_EQ(std::ldexp(static_cast<long double>(sum), -kFilmFractionBits), exact);
    EXPECT_EQ(film_mean(sum, kSamples), static_cast<float>(exact / kSamples));
    EXPECT_NE(plain / kSamples,
              static_cast<float>(exact / kSamples));  // negative control: a float sum is not
}

TEST(Film, mean_of_a_constant_stays_constant_past_every_counter_width) {
    const std::int64_t sample = fixed(0.7);
    const float expected = film_mean(sample, 1);
    for (const std::uint64_t count :
         {1ull, 65535ull, 65536ull, 1ull << 24, (1ull << 24) + 1, 1ull << 32, (1ull << 32) + 1})
        EXPECT_EQ(film_mean(sample * static_cast<std::int64_t>(count), count), expected) << count;
}

TEST(Film, order_of_the_samples_does_not_matter) {
    std::int64_t forward = 0, backward = 0;
    for (std::uint32_t i = 0; i < 1000; ++i) {
        forward += fixed(static_cast<double>(test::hash32(i)) * 1e-9);
        backward += fixed(static_cast<double>(test::hash32(999 - i)) * 1e-9);
    }
    EXPECT_EQ(forward, backward);
}

TEST(Film, image_is_the_mean_of_both_halves) {
    const std::vector<std::int64_t> a = {fixed(3.0), fixed(6.0), 0, fixed(1.0), 0, 0};
    const std::vector<std::int64_t> b = {fixed(1.0), fixed(2.0), 0, fixed(2.0), 0, 0};
    const std::vector<std::uint64_t> na = {3, 1}, nb = {1, 0};
    const Image image = film_image(2, 1, {a, na}, {b, nb});
    EXPECT_EQ(image.channels.at("R").pixels, (std::vector<float>{1.0f, 3.0f}));
    EXPECT_EQ(image.channels.at("G").pixels, (std::vector<float>{2.0f, 0.0f}));
    EXPECT_EQ(image.channels.at("sampleCount.Y").pixels, (std::vector<float>{4.0f, 1.0f}));
    EXPECT_EQ(image.channels.at("R").precision, Image::Precision::half);
    EXPECT_EQ(image.channels.at("error.Y").precision, Image::Precision::single);
}

TEST(Film, error_plane_of_equal_halves_is_half_their_difference) {
    const std::vector<std::int64_t> a(3, fixed(4.0)), b(3, fixed(2.0));
    const std::vector<std::uint64_t> n = {4};
    const Image image = film_image(1, 1, {a, n}, {b, n});
    EXPECT_FLOAT_EQ(image.channels.at("error.Y").pixels[0], 0.25f);  // |1 - 0.5| / 2
}

TEST(Film, pixel_without_samples_is_black) {
    const std::vector<std::int64_t> sums(3, 0);
    const std::vector<std::uint64_t> none = {0};
    const Image image = film_image(1, 1, {sums, none}, {sums, none});
    for (const auto& [name, channel] : image.channels)
        EXPECT_EQ(channel.pixels[0], 0.0f) << name;
}

TEST(Film, plane_of_interleaved_sums_picks_its_component) {
    const std::vector<std::int64_t> sums = {fixed(1), fixed(2), fixed(3), fixed(-4)};
    EXPECT_EQ(mean_plane(sums, 2, 1, 2), (std::vector<float>{1.0f, -2.0f}));
}

TEST(FilmError, squared_error_plane_is_unbiased_for_unequal_halves) {
    Random random(20240501);
    const Noise noise{.width = 200, .height = 200, .na = 48, .nb = 16};
    const Trial trial = make_trial(noise, random);
    const Image image = film_image(noise.width, noise.height, trial.half_a(), trial.half_b());
    double estimated = 0.0, actual = 0.0;
    for (std::size_t i = 0; i < pixel_count(image); ++i) {
        const double n = static_cast<double>(noise.na + noise.nb) * (1 << kFilmFractionBits);
        const auto mean = [&](std::size_t c) {
            return static_cast<double>(trial.a[3 * i + c] + trial.b[3 * i + c]) / n;
        };
        const double d = 0.2126 * mean(0) + 0.7152 * mean(1) + 0.0722 * mean(2) - trial.truth[3 * i];
        const double e = static_cast<double>(image.channels.at("error.Y").pixels[i]);
        actual += d * d;
        estimated += e * e;
    }
    // Both are means of 40 000 squares of one Gaussian each, weighted by radiance^4: about 1.2 % each at one
    // sigma.
    EXPECT_NEAR(estimated / actual, 1.0, 0.07);
}

test::IntervalCoverage coverage_of(const Noise& noise, int trials) {
    Random random(7);
    test::IntervalCoverage result;
    for (int trial = 0; trial < trials; ++trial) {
        const Trial pixels = make_trial(noise, random);
        result.add(estimate_of(noise, pixels), true_error(pixels));
    }
    return result;
}

class FilmErrorCoverage : public testing::TestWithParam<Noise> {};

TEST_P(FilmErrorCoverage, interval_holds_the_true_error_as_often_as_it_claims) {
    test::expect_honest(coverage_of(GetParam(), 1000));
}

INSTANTIATE_TEST_SUITE_P(Noise, FilmErrorCoverage,
                         testing::Values(Noise{}, Noise{.na = 64, .nb = 16},
                                         Noise{.kind = NoiseKind::ambient_occlusion, .na = 8, .nb = 8},
                                         Noise{.kind = NoiseKind::ambient_occlusion, .na = 16, .nb = 16},
                                         Noise{.kind = NoiseKind::firefly},
                                         Noise{.kind = NoiseKind::decay, .na = 8, .nb = 8},
                                         Noise{.width = 16, .height = 12}));

// Negative control: halves that share most of their samples look four times as good as they are.
TEST(FilmError, interval_of_dependent_halves_misses) {
    Random random(8);
    const Noise noise;
    Trial trial = make_trial(noise, random);
    for (std::size_t i = 0; i < trial.a.size(); ++i)
        trial.b[i] = (trial.b[i] + 3 * trial.a[i]) / 4;
    EXPECT_LT(estimate_of(noise, trial).high, true_error(trial));
}

TEST(FilmError, estimate_falls_with_the_root_of_the_samples) {
    Random random(9);
    std::vector<double> estimates;
    for (const std::uint64_t n : {16u, 64u, 256u, 1024u, 4096u}) {
        const Noise noise{.width = 128, .height = 128, .na = n, .nb = n};
        estimates.push_back(estimate_of(noise, make_trial(noise, random)).estimate);
    }
    for (std::size_t i = 1; i < estimates.size(); ++i)
        EXPECT_NEAR(estimates[i - 1] / estimates[i], 2.0, 0.1);  // 49 152 squares: 0.5 % each at one sigma
}

TEST(FilmError, too_little_to_tell_gives_an_open_interval) {
    const std::vector<std::int64_t> a(3, fixed(1.0)), b(3, fixed(2.0));
    const std::vector<std::uint64_t> one = {1}, none = {0};
    const ErrorEstimate single = estimate_error(1, 1, {a, one}, {b, one});
    EXPECT_GT(single.estimate, 0.0);
    EXPECT_EQ(single.low, 0.0);
    EXPECT_TRUE(std::isinf(single.high));
    EXPECT_TRUE(std::isinf(estimate_error(1, 1, {a, one}, {b, none}).estimate));
}

TEST(FilmError, equal_halves_have_no_error) {
    const std::vector<std::int64_t> a(300, fixed(1.0));
    const std::vector<std::uint64_t> n = {2};
    const ErrorEstimate estimate = estimate_error(10, 10, {a, n}, {a, n});
    EXPECT_EQ(estimate.estimate, 0.0);
    EXPECT_EQ(estimate.high, 0.0);
}

}  // namespace
