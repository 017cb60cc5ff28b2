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

// What a frame is rendered from. It outlives the loop.
struct FrameInputs {
    Renderer& renderer;
    const RenderOptions& options;  // its own time limit
    const FilmStart& film;         // what the film holds already
    std::chrono::steady_clock::time_point start;
    ErrorPrior guess;                // of the error, when there is a target
    std::vector<NoiseShare> shares;  // of the noise, as far as they are known
};

// What a frame calls while it runs.
struct FrameCalls {
    std::function<void(const Progress&)> on_progress;  // after a tile
    std::function<void()> save;                        // as often as RenderOptions::checkpoint_s says
    // With a time limit, once after the first sample: does to a strip of rows what will be done to the image.
    std::function<void(RenderOutcome strip)> rehearse;
};

// Takes the samples of one frame: steps of the renderer until the stop rule ends them.
class SampleLoop {
  public:
    // Empties the film.
    explicit SampleLoop(const FrameInputs& inputs);

    // Renders until the frame is done or one of the options stops it.
    void run(const FrameCalls& calls);

    // What the film holds now: the image, and the numbers that are known here.
    [[nodiscard]] RenderOutcome outcome();

    // The errors that this frame itself has claimed so far.
    [[nodiscard]] std::vector<ErrorPoint> own_points() const { return watch_.own_points(); }

  private:
    [[nodiscard]] bool take_sample(const FrameCalls& calls);
    [[nodiscard]] bool is_checkpoint_wanted() const;
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
    double max_done_ = 0.0;  // that was told
};

}  // namespace voxilux
