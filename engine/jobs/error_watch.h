#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "estimators/error_curve.h"
#include "estimators/error_estimate.h"

namespace voxilux {

// The errors that a film has estimated so far, and the curve fitted to them.
class ErrorWatch {
  public:
    // `known`: points that were known before the first sample.
    ErrorWatch(const ErrorLaw& law, std::vector<ErrorPoint> known);

    void add(std::uint32_t samples, const ErrorEstimate& claim, double now_s);

    // Whether a new estimate should be shown, which decides nothing.
    [[nodiscard]] bool is_due(std::uint32_t samples, double now_s) const;

    [[nodiscard]] const std::optional<ErrorCurve>& curve() const { return curve_; }
    // The curve with one more point.
    [[nodiscard]] std::optional<ErrorCurve> curve_with(std::uint32_t samples,
                                                       const ErrorEstimate& claim) const;

    // The points that were added.
    [[nodiscard]] std::vector<ErrorPoint> own_points() const;

  private:
    ErrorLaw law_;
    std::size_t known_;
    std::vector<ErrorPoint> points_;
    std::optional<ErrorCurve> curve_;
    std::uint32_t last_samples_ = 0;
    double last_s_ = 0.0;
};

}  // namespace voxilux
