// The variance of pixels and the error of a picture from sums of squares, where samples are independent.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "estimators/error_estimate.h"
#include "estimators/film_error.h"
#include "estimators/metrics.h"
#include "film/film_sums.h"
#include "support/interval_coverage.h"

namespace voxilux {
namespace {

using Random = std::mt19937_64;

std::int64_t fixed(double value) {
    return std::llround(std::ldexp(value, kFilmFractionBits));
}

using test::NoiseKind;

struct NoisyFilm {
    NoiseKind kind = NoiseKind::gauss;
    int width = 32, height = 24;
    std::uint64_t n = 32;  // in each half
};

void PrintTo(const NoisyFilm& noise, std::ostream* out) {
    *out << test::name_of(noise.kind) << ' ' << noise.width << 'x' << noise.height << ", twice " << noise.n
         << " samples";
}

struct Draw {
    double sum = 0.0;
    double squares = 0.0;
};

// n samples of mean 1. Of Gaussian ones only what is asked for is drawn: the sum, and the squares about its
// mean, which are independent of it (W. G. Cochran, "The distribution of quadratic forms in a normal system",
// 1934).
Draw draw(NoiseKind kind, std::uint64_t n, double sigma, Random& random) {
    const double count = static_cast<double>(n);
    const auto events = [&](double p) {
        return static_cast<double>(std::binomial_distribution<std::uint64_t>(n, p)(random));
    };
    Draw result;
    switch (kind) {
        case NoiseKind::gauss: {
            result.sum = count + std::sqrt(count) * sigma * std::normal_distribution<double>()(random);
            const double about =
                n > 1 ? std::gamma_distribution<double>((count - 1.0) / 2.0, 2.0)(random) : 0.0;
            result.squares = result.sum * result.sum / count + sigma * sigma * about;
            return result;
        }
        case NoiseKind::ambient_occlusion: {
            const double open = events(0.6);
            return {open / 0.6, open / (0.6 * 0.6)};
        }
        case NoiseKind::firefly: {  // one sample in a hundred is 61 times as bright as the rest
            const double bright = events(0.01);
            return {(count + 60.0 * bright) / 1.6, (count - bright + 61.0 * 61.0 * bright) / (1.6 * 1.6)};
        }
        case NoiseKind::decay:  // exponential
            for (std::uint64_t i = 0; i < n; ++i) {
                const double sample = std::exponential_distribution<double>()(random);
                result.sum += sample;
                result.squares += sample * sample;
            }
            return result;
    }
    return result;
}

// Two halves and the squares of both, around a known picture.
struct Trial {
    std::vector<std::int64_t> a, b, squares;
    std::vector<double> truth;
    std::vector<std::uint64_t> n;

    [[nodiscard]] FilmHalf half_a() const { return {a, n}; }
    [[nodiscard]] FilmHalf half_b() const { return {b, n}; }
};

// Radiance rises from left to right by a factor of 20; the upper half is quiet where the noise is Gaussian.
Trial make_trial(const NoisyFilm& noise, Random& random) {
    Trial trial{.n = {noise.n}};
    for (int y = 0; y < noise.height; ++y) {
        for (int x = 0; x < noise.width; ++x) {
            const double brightness = 0.1 + 2.0 * x / noise.width;
            const double sigma = y < noise.height / 2 ? 0.2 : 0.7;
            const Draw a = draw(noise.kind, noise.n, sigma, random);
            const Draw b = draw(noise.kind, noise.n, sigma, random);
            for (int c = 0; c < 3; ++c) {
                trial.truth.push_back(brightness);
                trial.a.push_back(fixed(brightness * a.sum));
                trial.b.push_back(fixed(brightness * b.sum));
                trial.squares.push_back(fixed(brightness * brightness * (a.squares + b.squares)));
            }
        }
    }
    return trial;
}

double squared_error(const Trial& trial, std::size_t i) {
    const double n = 2.0 * static_cast<double>(trial.n[0]);
    const double mean = static_cast<double>(trial.a[i] + trial.b[i]) / n / (1 << kFilmFractionBits);
    return (mean - trial.truth[i]) * (mean - trial.truth[i]);
}

double true_error(const Trial& trial) {
    double sum = 0.0;
    for (std::size_t i = 0; i < trial.truth.size(); ++i)
        sum += squared_error(trial, i) / (trial.truth[i] * trial.truth[i] + kRelMseEpsilon);
    return std::sqrt(sum / static_cast<double>(trial.truth.size()));
}

ErrorEstimate estimate_of(const NoisyFilm& noise, const Trial& trial) {
    return estimate_error(noise.width, noise.height, trial.half_a(), trial.half_b(), trial.squares);
}

TEST(FilmVariance, of_known_samples_is_that_of_the_book) {
    // 1, 2, 4, 9: mean 4, variance of a sample 38 / 3, of the mean 38 / 12.
    const std::vector<std::int64_t> a(3, fixed(1.0 + 4.0)), b(3, fixed(2.0 + 9.0)), squares(3, fixed(102.0));
    const std::vector<std::uint64_t> two = {2};
    for (const double variance : mean_variance({a, two}, {b, two}, squares, 0))
        EXPECT_DOUBLE_EQ(variance, 38.0 / 12.0);
}

TEST(FilmVariance, is_unbiased) {
    Random random(11);
    for (const NoiseKind kind : {NoiseKind::gauss, NoiseKind::ambient_occlusion, NoiseKind::decay}) {
        const NoisyFilm noise{.kind = kind, .width = 200, .height = 200, .n = 8};
        const Trial trial = make_trial(noise, random);
        double estimated = 0.0, actual = 0.0;
        for (std::size_t i = 0; i < 200 * 200; ++i) {
            estimated += mean_variance(trial.half_a(), trial.half_b(), trial.squares, i)[0];
            actual += squared_error(trial, 3 * i);
        }
        // 40 000 squares of a Gaussian weighted by radiance^2: about 1.2 % at one sigma.
        EXPECT_NEAR(estimated / actual, 1.0, 0.05) << static_cast<int>(kind);
    }
}

TEST(FilmVariance, where_squares_are_full_the_halves_tell) {
    const std::vector<std::int64_t> a(3, fixed(8.0)), b(3, fixed(4.0)), full(3, kSquaresFull);
    const std::vector<std::uint64_t> four = {4};
    // (2 - 1)^2 / 4
    EXPECT_DOUBLE_EQ(mean_variance({a, four}, {b, four}, full, 0)[0], 0.25);
    // Equal halves: an emitter too bright for its sums of squares has no noise.
    EXPECT_EQ(mean_variance({a, four}, {a, four}, full, 0)[0], 0.0);
}

TEST(FilmVariance, rounding_never_makes_it_negative) {
    const std::vector<std::int64_t> sum(3, fixed(4.0)), squares(3, fixed(8.0) - 3);
    const std::vector<std::uint64_t> one = {1};
    EXPECT_EQ(mean_variance({sum, one}, {sum, one}, std::vector<std::int64_t>(3, fixed(32.0) - 3), 0)[0],
              0.0);
    // One sample gives no variance, only its own square.
    EXPECT_EQ(mean_variance({sum, one}, {std::vector<std::int64_t>(3, 0), std::vector<std::uint64_t>{0}},
                            squares, 0)[0],
              16.0);
}

TEST(FilmVariance, full_sums_stay_full_in_any_order) {
    FilmSums film{.width = 1, .height = 1, .even = {1}, .odd = {0}};
    for (const char* name : {"beauty_a", "beauty_b", "squares"})
        film.sums[name] = {1, 2, 3};
    FilmSums other = film;
    other.sums["squares"] = {kSquaresFull, kSquaresFull - 1, 5};
    FilmSums forwards = film, backwards = other;
    add_film(forwards, other);
    add_film(backwards, film);
    EXPECT_EQ(forwards.sums["squares"], (std::vector<std::int64_t>{kSquaresFull, kSquaresFull, 8}));
    EXPECT_EQ(backwards.sums["squares"], forwards.sums["squares"]);
}

test::IntervalCoverage coverage_of(const NoisyFilm& noise, int trials, bool with_squares = true) {
    Random random(7);
    test::IntervalCoverage result;
    for (int trial = 0; trial < trials; ++trial) {
        Trial pixels = make_trial(noise, random);
        if (!with_squares) pixels.squares.clear();
        result.add(estimate_of(noise, pixels), true_error(pixels));
    }
    return result;
}

class SquaresCoverage : public testing::TestWithParam<NoisyFilm> {};

TEST_P(SquaresCoverage, interval_holds_the_true_error_as_often_as_it_claims) {
    test::expect_honest(coverage_of(GetParam(), 1000));
}

INSTANTIATE_TEST_SUITE_P(NoisyFilm, SquaresCoverage,
                         testing::Values(NoisyFilm{}, NoisyFilm{.n = 4},
                                         NoisyFilm{.kind = NoiseKind::ambient_occlusion, .n = 8},
                                         NoisyFilm{.kind = NoiseKind::ambient_occlusion, .n = 32},
                                         NoisyFilm{.kind = NoiseKind::firefly},
                                         NoisyFilm{.kind = NoiseKind::decay, .n = 8},
                                         NoisyFilm{.width = 16, .height = 12}));

TEST(SquaresError, estimate_scatters_less_than_that_of_the_halves) {
    const test::IntervalCoverage squares = coverage_of(NoisyFilm{}, 200);
    const test::IntervalCoverage halves = coverage_of(NoisyFilm{}, 200, false);
    EXPECT_LT(squares.spread(), 0.4 * halves.spread());
    EXPECT_LT(squares.width(), halves.width());
}

// Negative control: taking each sample four times halves the error according to the squares.
TEST(SquaresError, interval_of_dependent_samples_misses) {
    Random random(8);
    const NoisyFilm noise;
    Trial trial = make_trial(noise, random);
    trial.n = {4 * noise.n};
    for (std::vector<std::int64_t>* sums : {&trial.a, &trial.b, &trial.squares}) {
        for (std::int64_t& sum : *sums)
            sum *= 4;
    }
    EXPECT_LT(estimate_of(noise, trial).high, true_error(trial));
}

TEST(SquaresError, films_without_independent_samples_use_the_halves) {
    Random random(9);
    const NoisyFilm noise;
    const Trial trial = make_trial(noise, random);
    FilmSums film{.width = noise.width, .height = noise.height};
    film.even.assign(24, 32);
    film.odd.assign(24, 32);
    film.sums = {{"beauty_a", trial.a}, {"beauty_b", trial.b}, {"squares", trial.squares}};
    const double from_halves = estimate_error(32, 24, trial.half_a(), trial.half_b()).estimate;
    EXPECT_EQ(error_of(film).estimate, from_halves);
    film.is_independent = true;
    EXPECT_EQ(error_of(film).estimate, estimate_of(noise, trial).estimate);
    EXPECT_NE(error_of(film).estimate, from_halves);
    film.sums.erase("squares");
    EXPECT_EQ(error_of(film).estimate, from_halves);
}

TEST(SquaresError, picture_has_the_variance_of_each_pixel) {
    Random random(10);
    const Trial trial = make_trial({.width = 4, .height = 3}, random);
    FilmSums film{.width = 4, .height = 3, .even = {32, 32, 32}, .odd = {32, 32, 32}};
    film.sums = {{"beauty_a", trial.a}, {"beauty_b", trial.b}, {"squares", trial.squares}};
    const Image image = picture_of(film);
    EXPECT_FALSE(image.channels.contains("squares.R"));
    for (std::size_t i = 0; i < 12; ++i) {
        const double want = mean_variance(trial.half_a(), trial.half_b(), trial.squares, i)[1];
        EXPECT_EQ(image.channels.at("variance.G").pixels[i], static_cast<float>(want));
    }
}

}  // namespace
}  // namespace voxilux
