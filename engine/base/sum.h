#pragma once

#include <cmath>

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

}  // namespace voxilux
