#pragma once

#include <future>
#include <optional>

#include "estimators/flip.h"

namespace voxilux {

// FLIP of a picture at rest against a reference. It takes longer than a sample, so a thread of its own
// computes it: again whenever the samples have doubled, and at the end.
class FlipMap {
  public:
    // Whether it should be computed for a film of so many samples.
    [[nodiscard]] bool is_due(std::uint32_t samples, bool is_last) const {
        return !pending_.valid() && samples > started_ && (is_last || samples >= 2 * started_);
    }
    void start(const Image& reference, Image test, std::uint32_t samples);
    // Whether there is another result now; waits for one that is being computed, if asked to.
    bool collect(bool waits);
    // The film is another one.
    void clear();

    // Nothing where there is none, or FLIP is not defined.
    [[nodiscard]] const std::optional<FlipResult>& result() const { return result_; }
    [[nodiscard]] double mean() const { return mean_; }

  private:
    std::future<std::optional<FlipResult>> pending_;
    std::optional<FlipResult> result_;
    double mean_ = 0.0;
    std::uint32_t started_ = 0;  // samples of the last one
    bool is_stale_ = false;      // what is computed now
};

}  // namespace voxilux
