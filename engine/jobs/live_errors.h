#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "estimators/error_curve.h"
#include "estimators/error_estimate.h"

namespace voxilux {

// What a film has cost and its error estimate, after a number of samples.
struct LiveError {
    std::uint32_t samples = 0;
    double seconds = 0.0;  // of taking samples
    double error = 0.0;    // root of relMSE
    double high = 0.0;     // the upper end of its interval
};

// How the error of a film falls while it is shown, and when it will be low enough. Reading a film costs about
// a sample, so it is read when its samples have doubled or may be enough.
class LiveErrors {
  public:
    // Begins with an empty film.
    void start(const ErrorLaw& law);
    void set_target(std::optional<double> error) { target_ = error; }

    // Adds time spent on samples.
    void add_time(double seconds) { seconds_ += seconds; }
    [[nodiscard]] double seconds() const { return seconds_; }

    // Whether the film should be read now.
    [[nodiscard]] bool is_due(std::uint32_t samples) const { return samples >= next_look_; }
    [[nodiscard]] std::uint32_t next_look() const { return next_look_; }
    void add(std::uint32_t samples, const ErrorEstimate& claim);

    [[nodiscard]] const std::vector<LiveError>& points() const { return points_; }
    // Whether the last estimate is within the target.
    [[nodiscard]] bool has_reached_target() const;

    // The error that is expected after a number of samples; nothing while unknown.
    [[nodiscard]] std::optional<double> expected(double samples) const;
    // Samples, and seconds from now on, until an error is reached; nothing where that is unknown or will
    // never happen.
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
