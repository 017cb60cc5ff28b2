#pragma once

#include <cmath>
#include <numbers>

namespace voxilux {

// A running sum that carries its own rounding error: after any number of additions the result is within a few
// ULP of the exact sum (A. Neumaier, "Rundungsfehleranalyse einiger Verfahren zur Summation endlicher
// Summen", 1974).
class CompensatedSum {
  public:
    void add(double x) {
        const double next = sum_ + x;
        error_ += std::abs(sum_) >= std::abs(x) ? (sum_ - next) + x : (x - next) + sum_;
        sum_ = next;
    }
    [[nodiscard]] double value() const { return sum_ + error_; }

  private:
    double sum_ = 0.0;
    double error_ = 0.0;
};

inline constexpr double kOneSided95 = 1.6448536269514722;  // quantile of the normal distribution

// Quantile of Student's t with `degrees` of freedom, from the normal quantile `z` of the same probability:
// Abramowitz and Stegun 26.7.5, four terms; within 0.2 % from 3 degrees on for z = 1.96.
[[nodiscard]] inline double student_quantile(double z, double degrees) {
    const double z2 = z * z;
    const double first = (z2 + 1.0) / 4.0;
    const double second = ((5.0 * z2 + 16.0) * z2 + 3.0) / 96.0;
    const double third = (((3.0 * z2 + 19.0) * z2 + 17.0) * z2 - 15.0) / 384.0;
    const double fourth = ((((79.0 * z2 + 776.0) * z2 + 1482.0) * z2 - 1920.0) * z2 - 945.0) / 92160.0;
    return z * (1.0 + (first + (second + (third + fourth / degrees) / degrees) / degrees) / degrees);
}

// Student's t, two-sided at 95 %: the true value lies within this many standard errors, where the error was
// estimated from `degrees` >= 1 degrees of freedom. Closed forms for 1 and 2.
[[nodiscard]] inline double student_quantile_95(double degrees) {
    if (degrees < 1.5) return std::tan(0.475 * std::numbers::pi);
    if (degrees < 2.5) return 0.95 * std::sqrt(2.0 / (1.0 - 0.95 * 0.95));
    return student_quantile(1.959963984540054, degrees);
}

}  // namespace voxilux
