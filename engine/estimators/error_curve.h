#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "estimators/error_estimate.h"

namespace voxilux {

// The estimated error of a film of so many samples. Squares, in the units of relMSE.
struct ErrorPoint {
    double samples = 0.0;
    double noise = 0.0;
    double noise_high = 0.0;      // upper end of its interval
    double bias = 0.0;            // as measured: may be below 0
    double bias_deviation = 0.0;  // 0 where nothing is known of bias
};

// Nothing where the estimate is unknown, or an end of its interval infinite.
[[nodiscard]] std::optional<ErrorPoint> error_point(double samples, const ErrorEstimate& estimate);

// How noise may fall with the number of samples. Independent ones: as 1/n. Those of a sequence: as a
// power of n between 1/n and 1/n^2. Photons: between 1/n and n^-alpha, as the variance of iteration i grows
// as i^(1-alpha).
enum class NoiseLaw : std::uint8_t { independent, sequence, photons };

struct ErrorLaw {
    NoiseLaw noise = NoiseLaw::independent;
    double alpha = 1.0;  // of the photons' radius
    bool has_bias = false;

    bool operator==(const ErrorLaw&) const = default;
};

inline constexpr std::size_t kShapes = 17;

// A quantity that falls as one of kShapes laws, from the slowest to the fastest that theory allows: how
// likely each is after what was measured, and its factor.
struct ConvergenceCurve {
    std::array<double, kShapes> chance{};
    std::array<double, kShapes> factor{};
    std::array<double, kShapes> deviation{};  // of the factor
    double reference = 1.0;                   // sample count at which the laws are 1
};

// How the error of a render and its upper bound fall.
struct ErrorCurve {
    ErrorLaw law;
    ConvergenceCurve noise;
    ConvergenceCurve bias;     // all zero without bias
    double spread = 1.0;       // noise_high / noise
    double scatter = 0.0;      // standard deviation of log(noise) from one set of random numbers to the next
    double uncertainty = 0.0;  // bias_high - bias at the last point
    double last = 1.0;         // its samples
};

// Fits the points, which need not be in order. Nothing when there are none, or one has no noise above 0.
[[nodiscard]] std::optional<ErrorCurve> fit_error(const ErrorLaw& law, std::span<const ErrorPoint> points);

// Expected error bound after so many samples, a root of relMSE: the upper end of the interval of the error.
// So many `deviations` of the curve and of the bound itself are added to the noise, and of the curve to the
// bias.
[[nodiscard]] double claimed_error(const ErrorCurve& curve, double samples, double deviations = 0.0);

// The same for the error itself: noise and bias without intervals.
[[nodiscard]] double expected_error(const ErrorCurve& curve, double samples);
[[nodiscard]] double expected_bias(const ErrorCurve& curve, double samples);

// Most samples that a film may sum exactly, shared/film_sum.h.
inline constexpr std::uint32_t kMaxSamples = 1u << 20;

// The fewest samples with which claimed_error() is at most `error`; nothing when kMaxSamples do not suffice.
[[nodiscard]] std::optional<std::uint32_t> samples_for(const ErrorCurve& curve, double error,
                                                       double deviations = 0.0);

// Mean of i^power over i = 1 ... n, for a power in [-1, 1] and n >= 1; n may be fractional.
[[nodiscard]] double mean_power(double n, double power);

}  // namespace voxilux
