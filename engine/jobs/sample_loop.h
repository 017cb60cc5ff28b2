#pragma once

#include <chrono>
#include <functional>
#include <vector>

#include "base/clock.h"
#include "jobs/checkpoint_timer.h"
#include "jobs/error_watch.h"
#include "jobs/frame_clock.h"
#include "jobs/progress_estimate.h"
#include "jobs/render_options.h"
#include "jobs/stop_rule.h"
#include "renderer/renderer.h"

namespace voxilux {

// The inputs of a frame. They outlive the loop.
struct FrameInputs {
    Renderer& renderer;
    const RenderOptions& options;  // with the frame's own time limit
    const FilmStart& film;         // what the film holds already
    std::chrono::steady_clock::time_point start;
    ErrorPrior guess;                // of the error, when there is a target
    std::vector<NoiseShare> shares;  // of the noise, as far as known
    // Of the image that will be shown, where that is not the plain one, whose error is the second argument.
    std::function<ErrorEstimate(const FilmSums&, const ErrorEstimate&)> claim;
};

// What a frame calls while it runs.
struct FrameCalls {
    std::function<void(const Progress&)> on_progress;  // after a tile
    std::function<void()> save;                        // called every RenderOptions::checkpoint_s
    // With a time limit, called once after the first sample: does with a strip of rows what will be done with
    // the image.
    std::function<void(RenderOutcome strip)> rehearse;
};

// Takes the samples of one frame: steps of the renderer until the stop rule ends them.
class SampleLoop {
  public:
    // Clears the film.
    explicit SampleLoop(const FrameInputs& inputs);

    // Renders until the frame is done or one of the options stops it.
    void run(const FrameCalls& calls);

    // What the film holds now: the image, and the numbers known here.
    [[nodiscard]] RenderOutcome outcome();

    // The errors that this frame itself has estimated so far.
    [[nodiscard]] std::vector<ErrorPoint> own_points() const { return watch_.own_points(); }

  private:
    [[nodiscard]] bool take_sample(const FrameCalls& calls);
    [[nodiscard]] bool is_checkpoint_wanted() const;
    [[nodiscard]] bool has_time_to_look() const;
    [[nodiscard]] ErrorEstimate measure_error();
    void rehearse_end(const std::function<void(RenderOutcome)>& rehearse);
    void report_progress(const std::function<void(const Progress&)>& on_progress);
    [[nodiscard]] FrameProgress stand() const;
    void add_projection(RenderStatistics& statistics) const;
    [[nodiscard]] std::uint32_t samples() const { return inputs_.renderer.film().position().samples; }

    const FrameInputs& inputs_;
    ErrorWatch watch_;
    StopRule rule_;
    CheckpointTimer checkpoints_;
    FrameClock clock_;
    RenderStatistics statistics_;
    double max_done_ = 0.0;  // last reported
};

}  // namespace voxilux
