#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "jobs/error_rounds.h"
#include "jobs/render_options.h"

namespace voxilux {

// What ends a frame: the samples that were asked for, an error that is low enough, a time limit, or an
// interruption.
class StopRule {
  public:
    // The options outlive this; `done`: samples that the film has already.
    StopRule(const RenderOptions& options, const RenderPlan& plan, const ErrorPrior& guess,
             std::uint32_t done);

    // Whether the frame has all its samples. Their error is measured where a round ends, and only there it
    // decides.
    [[nodiscard]] bool is_done(std::uint32_t samples, const std::function<ErrorEstimate()>& measure);

    // Whether no tile may begin that would end at `end_s`, from the start of the frame. The first sample is
    // always finished, so that the image is whole; later a tile that would end too late to write the image
    // in time is not begun.
    [[nodiscard]] bool stops_before(double end_s, std::uint32_t samples);

    // Keeps so much of the time limit for what comes after the last sample.
    void keep_for_end(double seconds) { end_s_ = seconds; }

    [[nodiscard]] std::optional<double> time_limit_s() const { return options_.time_limit_s; }
    [[nodiscard]] double kept_s() const { return end_s_; }
    [[nodiscard]] StopReason reason() const { return reason_; }
    // Samples that the frame is expected to end with.
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
