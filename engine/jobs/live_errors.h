#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "estimators/error_curve.h"
#include "estimators/error_estimate.h"

namespace voxilux {

// What a film has cost and claimed after so many samples.
struct LiveError {
    std::uint32_t samples = 0;
    double seconds = 0.0;  // of taking samples
    double error = 0.0;    // root of relMSE
    double high = 0.0;     // the upper end of its interval
};

// How the error of a film falls while somebody watches, and when it will be low enough. Reading a film costs
// about a sample, so it is looked at when its samples have doubled, or may be enough.
class LiveErrors {
  public:
    // Begins with an empty film.
    void start(const ErrorLaw& law);
    void set_target(std::optional<double> error) { target_ = error; }

    // Samples took so long.
    void add_time(double seconds) { seconds_ += seconds; }
    [[nodiscard]] double seconds() const { return seconds_; }

    // Whether the film is to be looked at now.
    [[nodiscard]] bool is_due(std::uint32_t samples) const { return samples >= next_look_; }
    [[nodiscard]] std::uint32_t next_look() const { return next_look_; }
    void add(std::uint32_t samples, const ErrorEstimate& claim);

    [[nodiscard]] const std::vector<LiveError>& points() const { return points_; }
    // Whether the last claim is within the target.
    [[nodiscard]] bool has_reached_target() const;

    // The error that is expected after so many samples; nothing while nothing is known.
    [[nodiscard]] std::optional<double> expected(double samples) const;
    // Samples, and seconds from now on, until an error will be claimed; nothing where that cannot be told or
    // will never be.
    [[nodiscard]] std::optional<std::uint32_t> samples_until(double error) const;
    [[nodiscard]] std::optional<double> seconds_until(double error) const;

  private:
    static constexpr std::uint32_t kFirstLook = 4;

    ErrorLaw law_;
    std::optional<double> target_;
    std::vector<ErrorPoint> claims_;
    std::vector<LiveError> points_;
    std::optional<ErrorCurve> curve_;
    double seconds_ = 0.0;
    std::uint32_t next_look_ = kFirstLook;
};

}  // namespace voxilux
