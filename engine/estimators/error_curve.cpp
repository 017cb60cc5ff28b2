// Extrapolates the estimated error of a film. Theory says between which two laws noise and bias fall, but not
// which law an image follows: that depends on how its light is mixed. So every law between the two gets a
// probability by how well it fits the errors measured at some sample counts, and forecasts are means over all
// of them. Where points are few, the prior below decides, and the deviation is large.
//
// Noise of a scrambled sequence: n^-1 where an image is too complex for it, n^(-1 - 1/d) for an edge in d
// dimensions, up to n^-2 and more where it is smooth (Z. He and X. Wang 2015, "On the Convergence Rate of
// Randomized Quasi-Monte Carlo for Discontinuous Functions", SIAM J. Numer. Anal. 53(5)).
//
// Noise of photons: the variance of iteration i is v0 + v1 i^(1-alpha), v0 of what has no photons in it and
// v1 of what has, since the variance of a density estimate is inverse to the kernel's area (Knaus and Zwicker
// 2011, "Progressive Photon Mapping: A Probabilistic Approach", ACM TOG 30(3), sections 4 and 5). So the mean
// of n iterations has variance (v0 + v1 mean_power(n, 1 - alpha)) / n. The bias of iteration i falls as the
// kernel's area, i^(alpha-1), inside a surface, and more slowly near its edges, so that its square lies
// between n^(2(alpha-1)) and a constant.

#include "estimators/error_curve.h"

#include <algorithm>
#include <cmath>

#include "base/assert.h"
#include "base/statistics.h"
#include "estimators/error_estimate.h"

namespace voxilux {
namespace {

// The place between the two laws, 0 the slow and 1 the fast one, before anything is measured.
struct Prior {
    double mean = 0.5;
    double deviation = 0.25;
};
// n^-1.3 to n^-1.5 in images of scenes/ from 4 to 512 samples, with Sobol and Halton alike.
constexpr Prior kSequencePrior{.mean = 0.42, .deviation = 0.15};
// Photons and the rest have similar parts in the noise at the first radius.
constexpr Prior kPhotonPrior{.mean = 0.6, .deviation = 0.3};
// At edges the bias falls as the radius itself, which is the place one half.
constexpr Prior kBiasPrior{.mean = 0.45, .deviation = 0.25};

// Least relative deviation of a point: the noise estimated from few samples is off by some percent, since its
// denominators are estimates, too.
constexpr double kMinScatter = 0.03;
// The part of the variance of the interval whose upper end is noise_high that is the estimate's own.
constexpr double kOwnVariance = 0.5;
// Deviation of log(noise_high / noise), relative to it: images of few pixels, or few noisy ones.
constexpr double kSpreadScatter = 0.2;
constexpr double kExactTerms = 64.0;  // of a sum, before it becomes an integral

enum class Quantity { noise, bias };

// The law number `shape` at `samples`, 1 at `reference`.
double law_at(const ErrorLaw& law, Quantity quantity, std::size_t shape, double samples, double reference) {
    const double place = static_cast<double>(shape) / static_cast<double>(kShapes - 1);
    const double ratio = reference / samples;
    if (quantity == Quantity::bias) return std::pow(ratio, 2.0 * (1.0 - law.alpha) * place);
    if (law.noise == NoiseLaw::independent) return ratio;
    if (law.noise == NoiseLaw::sequence) return std::pow(ratio, 1.0 + place);
    const double power = 1.0 - law.alpha;
    const double growth = mean_power(samples, power) / mean_power(reference, power);
    return ratio * ((1.0 - place) * growth + place);
}

struct Measured {
    double samples = 0.0;
    double value = 0.0;
    double deviation = 0.0;
};

Prior prior_of(const ErrorLaw& law, Quantity quantity) {
    if (quantity == Quantity::bias) return kBiasPrior;
    return law.noise == NoiseLaw::sequence ? kSequencePrior : kPhotonPrior;
}

// Least squares for the factor of each law; probabilities from the residuals (Gaussian errors).
ConvergenceCurve fit_decline(const ErrorLaw& law, Quantity quantity, const std::vector<Measured>& points) {
    const auto [first, last] = std::ranges::minmax(points, {}, &Measured::samples);
    ConvergenceCurve fit{.reference = std::sqrt(first.samples * last.samples)};
    const Prior prior = prior_of(law, quantity);
    std::array<double, kShapes> misfit{};
    for (std::size_t shape = 0; shape < kShapes; ++shape) {
        double square = 0.0, product = 0.0, total = 0.0;
        for (const Measured& point : points) {
            const double weight = 1.0 / (point.deviation * point.deviation);
            const double at = law_at(law, quantity, shape, point.samples, fit.reference);
            square += weight * at * at;
            product += weight * at * point.value;
            total += weight * point.value * point.value;
        }
        fit.factor[shape] = std::max(product / square, 0.0);
        fit.deviation[shape] = std::sqrt(1.0 / square);
        const double place = static_cast<double>(shape) / static_cast<double>(kShapes - 1);
        const double surprise = (place - prior.mean) / prior.deviation;
        misfit[shape] = total - 2.0 * fit.factor[shape] * product +
                        fit.factor[shape] * fit.factor[shape] * square + surprise * surprise;
    }
    const double least = std::ranges::min(misfit);
    double sum = 0.0;
    for (std::size_t shape = 0; shape < kShapes; ++shape)
        sum += fit.chance[shape] = std::exp(-0.5 * (misfit[shape] - least));
    for (double& chance : fit.chance)
        chance /= sum;
    return fit;
}

struct Value {
    double mean = 0.0;
    double deviation = 0.0;
};

Value value_at(const ErrorLaw& law, Quantity quantity, const ConvergenceCurve& fit, double samples) {
    double mean = 0.0, square = 0.0;
    for (std::size_t shape = 0; shape < kShapes; ++shape) {
        const double at = law_at(law, quantity, shape, samples, fit.reference);
        const double value = fit.factor[shape] * at;
        const double own = fit.deviation[shape] * at;
        mean += fit.chance[shape] * value;
        square += fit.chance[shape] * (value * value + own * own);
    }
    return {mean, std::sqrt(std::max(square - mean * mean, 0.0))};
}

// Deviation of the logarithm of a noise, from one set of random numbers to the next.
double scatter_of(const ErrorPoint& point) {
    const double wide = std::sqrt(kOwnVariance) * std::log(point.noise_high / point.noise) / kClaimQuantile;
    return std::max(wide, kMinScatter);
}

double bias_high(const ErrorPoint& point) {
    return std::max(point.bias + kOneSided95 * point.bias_deviation, 0.0);
}

}  // namespace

std::optional<ErrorPoint> error_point(double samples, const ErrorEstimate& estimate) {
    if (!estimate.is_known() || !std::isfinite(estimate.high) || !std::isfinite(estimate.estimate)) return {};
    const double noise = estimate.noise.value_or(estimate.estimate);
    ErrorPoint point{.samples = samples, .noise = noise * noise, .noise_high = estimate.high * estimate.high};
    if (!estimate.bias_squared) return point;
    point.bias = estimate.bias_squared->squared;
    point.bias_deviation = estimate.bias_squared->deviation;
    point.noise_high = std::max(point.noise_high - bias_high(point), point.noise);
    return point;
}

double mean_power(double n, double power) {
    VX_ASSERT(n >= 1.0 && power >= -1.0 && power <= 1.0);
    const double exact = std::min(std::floor(n), kExactTerms);
    double sum = 0.0;
    for (double i = 1.0; i <= exact; i += 1.0)
        sum += std::pow(i, power);
    if (n <= kExactTerms) return sum / exact;
    const double from = exact + 0.5, to = n + 0.5;
    sum += power == -1.0 ? std::log(to / from)
                         : (std::pow(to, power + 1.0) - std::pow(from, power + 1.0)) / (power + 1.0);
    return sum / n;
}

std::optional<ErrorCurve> fit_error(const ErrorLaw& law, std::span<const ErrorPoint> points) {
    std::vector<Measured> noise, bias;
    ErrorCurve curve{.law = law};
    const ErrorPoint* last = nullptr;
    for (const ErrorPoint& point : points) {
        if (!(point.noise > 0.0)) return std::nullopt;
        noise.push_back({point.samples, point.noise, point.noise * scatter_of(point)});
        if (law.has_bias && point.bias_deviation > 0.0)
            bias.push_back({point.samples, point.bias, point.bias_deviation});
        if (last == nullptr || point.samples >= last->samples) last = &point;
    }
    if (last == nullptr) return std::nullopt;
    curve.noise = fit_decline(law, Quantity::noise, noise);
    if (!bias.empty()) curve.bias = fit_decline(law, Quantity::bias, bias);
    curve.spread = last->noise_high / last->noise;
    curve.scatter = scatter_of(*last);
    curve.last = last->samples;
    if (!bias.empty()) curve.uncertainty = kOneSided95 * last->bias_deviation;
    return curve;
}

double claimed_error(const ErrorCurve& curve, double samples, double deviations) {
    const Value noise = value_at(curve.law, Quantity::noise, curve.noise, samples);
    const double own = noise.mean * std::hypot(curve.scatter, kSpreadScatter * std::log(curve.spread));
    const double wide = std::sqrt(noise.deviation * noise.deviation + own * own);
    double square = curve.spread * std::max(noise.mean + deviations * wide, 0.0);
    if (curve.law.has_bias) {
        const Value bias = value_at(curve.law, Quantity::bias, curve.bias, samples);
        // The uncertainty is a product of two noises of photons.
        const double uncertainty = curve.uncertainty * std::pow(curve.last / samples, curve.law.alpha);
        square += std::max(bias.mean + deviations * bias.deviation, 0.0) + uncertainty;
    }
    return std::sqrt(square);
}

double expected_error(const ErrorCurve& curve, double samples) {
    double square = value_at(curve.law, Quantity::noise, curve.noise, samples).mean;
    if (curve.law.has_bias) square += value_at(curve.law, Quantity::bias, curve.bias, samples).mean;
    return std::sqrt(square);
}

double expected_bias(const ErrorCurve& curve, double samples) {
    return std::sqrt(value_at(curve.law, Quantity::bias, curve.bias, samples).mean);
}

std::optional<std::uint32_t> samples_for(const ErrorCurve& curve, double error, double deviations) {
    const auto suffices = [&](std::uint32_t n) { return claimed_error(curve, n, deviations) <= error; };
    if (!suffices(kMaxSamples)) return std::nullopt;
    std::uint32_t too_few = 0, enough = kMaxSamples;
    while (enough - too_few > 1) {
        const std::uint32_t middle = too_few + (enough - too_few) / 2;
        (suffices(middle) ? enough : too_few) = middle;
    }
    return enough;
}

}  // namespace voxilux
