#pragma once

#include <algorithm>
#include <chrono>

#include "base/clock.h"

namespace voxilux {

// Decides when the picture at rest is shown again: so rarely that showing takes one part in twenty of the
// time.
class ShowPace {
  public:
    // Called after a picture was shown, which took `show_s`.
    void add(double show_s) {
        mean_s_ += (show_s - mean_s_) * (mean_s_ > 0.0 ? kNew : 1.0);
        last_ = std::chrono::steady_clock::now();
    }
    // The mean time to show a picture, with more weight on recent ones.
    [[nodiscard]] double show_s() const { return mean_s_; }
    [[nodiscard]] bool is_due() const { return seconds_since(last_) >= interval_s(); }
    [[nodiscard]] double interval_s() const {
        return std::clamp(kParts * mean_s_, kMinInterval_s, kMaxInterval_s);
    }

  private:
    static constexpr double kNew = 0.25;  // weight of the newest
    static constexpr double kParts = 20.0;
    static constexpr double kMinInterval_s = 0.05;
    static constexpr double kMaxInterval_s = 0.5;

    double mean_s_ = 0.0;
    std::chrono::steady_clock::time_point last_;
};

}  // namespace voxilux
