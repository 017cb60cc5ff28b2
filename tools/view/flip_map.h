#pragma once

#include <future>
#include <optional>

#include "estimators/flip.h"

namespace voxilux {

// FLIP of a picture at rest against a reference. It takes longer than a sample, so another thread computes
// it: again whenever the samples have doubled, and after the last one.
class FlipMap {
  public:
    // Whether to compute it for a film of so many samples.
    [[nodiscard]] bool is_due(std::uint32_t samples, bool is_last) const {
        return !pending_.valid() && samples > started_ && (is_last || samples >= 2 * started_);
    }
    void start(const Image& reference, Image test, std::uint32_t samples);
    // Takes a finished result, if there is one, and returns whether it did. With `waits`, waits for the one
    // that is being computed.
    bool collect(bool waits);
    // Called when the film is another one: drops all results.
    void clear();

    // Empty before the first result, and where FLIP is not defined.
    [[nodiscard]] const std::optional<FlipResult>& result() const { return result_; }
    [[nodiscard]] double mean() const { return mean_; }

  private:
    std::future<std::optional<FlipResult>> pending_;
    std::optional<FlipResult> result_;
    double mean_ = 0.0;
    std::uint32_t started_ = 0;  // samples of the newest computation
    bool is_stale_ = false;      // the newest computation is of a film that is gone
};

}  // namespace voxilux
