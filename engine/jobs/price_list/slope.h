#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace voxilux {

// The price of an image: seconds, and error as sqrt(relMSE).
struct PricePoint {
    double time_s = 0.0;
    double error = 0.0;
};

// The exponent p of error = c time^p, with its 95 % interval.
struct Slope {
    double value = 0.0;
    double low = 0.0;
    double high = 0.0;
};

// The least-squares line through the logarithms, with an interval by Student's t of the residuals. Points
// whose error or time has no logarithm are left out. Nothing for fewer than three points or equal times.
[[nodiscard]] std::optional<Slope> fit_slope(std::span<const PricePoint> points);

// The points that none beats in both time and error, by increasing time; of equal points the first.
[[nodiscard]] std::vector<std::size_t> pareto_front(std::span<const PricePoint> points);

}  // namespace voxilux
