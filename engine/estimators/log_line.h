#pragma once

#include <optional>
#include <span>

namespace voxilux {

// The least-squares line through the logarithms of points: y = c x^slope.
struct LogLine {
    double slope = 0.0;
    double spread = 0.0;    // sum of squared deviations of log x from their mean
    double residual = 0.0;  // sum of squared deviations of log y from the line
};

// Nothing for values that have no logarithm, and where all x are equal but for rounding.
[[nodiscard]] std::optional<LogLine> fit_log_line(std::span<const double> x, std::span<const double> y);

}  // namespace voxilux
