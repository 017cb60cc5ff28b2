#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace voxilux {

// A picture's price: seconds, and error as sqrt(relMSE).
struct PricePoint {
    double time_s = 0.0;
    double error = 0.0;
};

// The exponent p of error = c time^p, with its interval of 95 %.
struct Slope {
    double value = 0.0;
    double low = 0.0;
    double high = 0.0;
};

// The least-squares line through the logarithms, its interval by Student's t of the residuals. Points with an
// error or a time that has no logarithm are left out. Nothing for fewer than three points or equal times.
[[nodiscard]] std::optional<Slope> fit_slope(std::span<const PricePoint> points);

// The points that none beats in both time and error, by rising time; of equal points the first.
[[nodiscard]] std::vector<std::size_t> pareto_front(std::span<const PricePoint> points);

}  // namespace voxilux
