#pragma once

#include <algorithm>

namespace voxilux {

// When a checkpoint is due. Checkpoints of large images take seconds, so the pause between two is at least
// kMinPauses times as long as the last one took.
class CheckpointTimer {
  public:
    // `period_s`: between checkpoints; 0: none.
    explicit CheckpointTimer(double period_s) : period_s_(period_s), next_s_(period_s) {}

    [[nodiscard]] bool is_due(double now_s) const { return period_s_ > 0.0 && now_s >= next_s_; }
    void saved(double begin_s, double end_s) {
        next_s_ = end_s + std::max(period_s_, kMinPauses * (end_s - begin_s));
    }

  private:
    static constexpr double kMinPauses = 9.0;

    double period_s_;
    double next_s_;
};

}  // namespace voxilux
