// Row 35 of the list of hard cases: the error of progressive photon mapping falls at the published rates.
// Source: C. Knaus and M. Zwicker 2011, "Progressive Photon Mapping: A Probabilistic Approach", ACM TOG
// 30(3): the variance of the mean of n iterations falls with n^-alpha, its bias with n^(alpha - 1).

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "support/frame_fixture.h"
#include "support/light_scenes.h"

namespace voxilux {
namespace {

constexpr double kRatePi = std::numbers::pi;
constexpr double kAlpha = 2.0 / 3.0;
// The published exponents are limits; over these iterations the law itself, summed up, has slopes 0.05 to
// 0.07 beside them. What is left is the scatter of eight seeds.
constexpr double kSlopeTolerance = 0.08;
constexpr double kFirstRadius = 2.0;     // voxels
constexpr std::uint32_t kFirst = 2;      // iterations of the shortest render
constexpr std::uint32_t kDoublings = 7;  // two decades: 2 to 256 iterations
constexpr std::uint32_t kIterations = kFirst << kDoublings;
constexpr std::uint32_t kSeeds = 8;

// A floor that sees a ball of light in a mirror, as light from behind the wall x = 0: a caustic whose
// irradiance is known.
constexpr double kAlbedo = 0.5;
constexpr double kEmitterRadius = 0.25;
constexpr double kEmitterRadiance = 100.0;
constexpr double kEmitterHeight = 2.0;
constexpr double kEmitterDistance = 1.0;  // from the mirror
constexpr double kSeenAt = 3.0;           // the middle of the picture, from the mirror

Scene mirror_scene(std::uint32_t seed, double alpha) {
    Scene scene = test::dark_scene(4, 16384, kFirstRadius);
    scene.settings.photons.alpha = alpha;
    scene.settings.seed = seed;
    scene.settings.sequence = Sequence::white;
    test::add_box(scene, {0, -16, -1}, {16, 16, 0}, test::add_diffuse(scene, static_cast<float>(kAlbedo)));
    test::add_box(scene, {-1, -16, -1}, {0, 16, 16}, test::add_mirror(scene));
    const std::uint16_t emitter = test::add_emitter(scene, static_cast<float>(kEmitterRadiance));
    scene.spheres.push_back({glm::dvec3(kEmitterDistance, 0.0, kEmitterHeight), kEmitterRadius, emitter});
    scene.camera = test::camera_towards({kSeenAt, 0.0, 12.0}, {kSeenAt, 1e-3, 0.0}, 0.01);
    return scene;
}

// Radiance of the floor at x from the mirror and y along it, by the form factor of a ball that is seen whole
// (Howell, catalogue of configuration factors, B-54).
double radiance_at(double x, double y) {
    const double across = x + kEmitterDistance;
    const double squared = across * across + y * y + kEmitterHeight * kEmitterHeight;
    const double irradiance = kRatePi * kEmitterRadiance * kEmitterRadius * kEmitterRadius * kEmitterHeight /
                              (squared * std::sqrt(squared));
    return kAlbedo * irradiance / kRatePi;
}

// Mean over a disc round the middle: rings of equal area and equal angles, each taken in its middle. Fine
// enough for seven digits.
double radiance_of_disc(double radius) {
    constexpr int kRings = 200, kAngles = 64;
    double sum = 0.0;
    for (int ring = 0; ring < kRings; ++ring) {
        const double r = radius * std::sqrt((ring + 0.5) / kRings);
        for (int k = 0; k < kAngles; ++k) {
            const double angle = 2.0 * kRatePi * (k + 0.5) / kAngles;
            sum += radiance_at(kSeenAt + r * std::cos(angle), r * std::sin(angle));
        }
    }
    return sum / (kRings * kAngles);
}

// The bias of the mean of the first iterations, relative: entry n - 1 for n of them.
std::vector<double> expected_bias(double alpha) {
    std::vector<double> bias;
    double squared = kFirstRadius * kFirstRadius, sum = 0.0;
    for (std::uint32_t i = 1; i <= kIterations; ++i) {
        sum += radiance_of_disc(std::sqrt(squared)) / radiance_at(kSeenAt, 0.0) - 1.0;
        bias.push_back(sum / i);
        squared *= (i + alpha) / (i + 1.0);
    }
    return bias;
}

// Errors of the mean of n iterations, relative, from all seeds.
struct RateRow {
    double iterations = 0.0;
    double bias = 0.0;
    double deviation = 0.0;  // of the bias
    double variance = 0.0;   // of one seed's mean
};

// Green of the middle of the picture, iteration by iteration.
std::vector<double> iterations_of(std::uint32_t seed, double alpha) {
    const PlanRequest request{
        .effects = {.switches = {{Effect::direct, Switch::off}, {Effect::indirect, Switch::off}}}};
    test::FrameFixture fixture(mirror_scene(seed, alpha), request);
    std::vector<double> values;
    for (std::uint32_t i = 0; i < kIterations; ++i) {
        const test::FramePlanes planes = fixture.render(i);
        double sum = 0.0;
        for (const glm::vec3& colour : planes.color)
            sum += static_cast<double>(colour.y);
        values.push_back(sum / static_cast<double>(planes.color.size()));
    }
    return values;
}

std::vector<RateRow> measure_rates(double alpha) {
    std::vector<std::vector<double>> seeds;
    for (std::uint32_t seed = 1; seed <= kSeeds; ++seed)
        seeds.push_back(iterations_of(seed, alpha));
    const double truth = radiance_at(kSeenAt, 0.0);
    std::vector<RateRow> rows;
    for (std::uint32_t n = kFirst; n <= kIterations; n *= 2) {
        // Iterations are independent, so each one's variance is taken over the seeds and these are added up:
        // that scatters much less than the variance of eight means.
        double mean = 0.0, variance = 0.0;
        for (std::uint32_t i = 0; i < n; ++i) {
            double sum = 0.0, squares = 0.0;
            for (const std::vector<double>& values : seeds) {
                sum += values[i] / truth;
                squares += values[i] * values[i] / (truth * truth);
            }
            mean += sum / kSeeds / n;
            variance += (squares - sum * sum / kSeeds) / (kSeeds - 1.0) / n / n;
        }
        rows.push_back({n * 1.0, mean - 1.0, std::sqrt(variance / kSeeds), variance});
    }
    return rows;
}

// Slope of a line through logarithms, each row weighing the same.
double log_slope(const std::vector<RateRow>& rows, double RateRow::*value) {
    double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
    const double count = static_cast<double>(rows.size());
    for (const RateRow& row : rows) {
        const double a = std::log(row.iterations), b = std::log(row.*value);
        x += a, y += b, xx += a * a, xy += a * b;
    }
    return (count * xy - x * y) / (count * xx - x * x);
}

TEST(Row35Nightly, error_of_photons_falls_at_the_published_rates_for_two_decades) {
    const std::vector<double> expected = expected_bias(kAlpha);
    const std::vector<RateRow> rows = measure_rates(kAlpha);
    for (const RateRow& row : rows) {
        const double bias = expected[static_cast<std::size_t>(row.iterations) - 1];
        EXPECT_NEAR(row.bias, bias, 4.0 * row.deviation) << row.iterations;
    }
    EXPECT_NEAR(log_slope(rows, &RateRow::bias), kAlpha - 1.0, kSlopeTolerance);
    EXPECT_NEAR(log_slope(rows, &RateRow::variance), -kAlpha, kSlopeTolerance);
    RecordProperty("bias_slope", std::to_string(log_slope(rows, &RateRow::bias)));
    RecordProperty("variance_slope", std::to_string(log_slope(rows, &RateRow::variance)));
}

// Negative control: with a radius that stays the bias stays, too, and the variance falls faster.
TEST(Row35Nightly, error_at_a_radius_that_stays_falls_at_other_rates) {
    const std::vector<RateRow> rows = measure_rates(1.0);
    EXPECT_NEAR(log_slope(rows, &RateRow::bias), 0.0, kSlopeTolerance);
    EXPECT_NEAR(log_slope(rows, &RateRow::variance), -1.0, kSlopeTolerance);
    EXPECT_GT(std::abs(rows.back().bias - expected_bias(kAlpha).back()), 4.0 * rows.back().deviation);
}

}  // namespace
}  // namespace voxilux
