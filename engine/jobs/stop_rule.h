#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "jobs/error_rounds.h"
#include "jobs/render_options.h"

namespace voxilux {

// What ends a frame: the requested samples, an error that is low enough, a time limit, or an interruption.
class StopRule {
  public:
    // The options outlive this. `done`: samples that the film already has.
    StopRule(const RenderOptions& options, const RenderPlan& plan, const ErrorPrior& guess,
             std::uint32_t done);

    // Whether the frame has all its samples. Their error is measured only where a round ends.
    [[nodiscard]] bool is_done(std::uint32_t samples, const std::function<ErrorEstimate()>& measure);

    // Whether no tile may begin that would end at `end_s`, counted from the start of the frame. The first
    // sample is always completed, so that the image is whole. Later tiles that would leave too little time to
    // write the image are not begun.
    [[nodiscard]] bool stops_before(double end_s, std::uint32_t samples);

    // Reserves this much of the time limit for what comes after the last sample.
    void keep_for_end(double seconds) { end_s_ = seconds; }

    [[nodiscard]] std::optional<double> time_limit_s() const { return options_.time_limit_s; }
    [[nodiscard]] double kept_s() const { return end_s_; }
    [[nodiscard]] StopReason reason() const { return reason_; }
    // Sample count at which the frame is expected to end.
    [[nodiscard]] std::uint32_t end() const { return rounds_ ? rounds_->end() : max_samples_; }
    // Nothing without an error target.
    [[nodiscard]] const std::optional<ErrorRounds>& rounds() const { return rounds_; }

  private:
    const RenderOptions& options_;
    std::uint32_t max_samples_;
    std::optional<ErrorRounds> rounds_;
    double end_s_ = 0.0;
    StopReason reason_ = StopReason::finished;
};

}  // namespace voxilux
