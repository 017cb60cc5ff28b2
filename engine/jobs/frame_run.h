#pragma once

#include <chrono>
#include <functional>

#include "base/clock.h"
#include "film/film_sums.h"
#include "frame/frame_state.h"
#include "jobs/error_rounds.h"
#include "jobs/next_minute.h"
#include "jobs/progress_estimate.h"
#include "jobs/render_session.h"
#include "renderer/film_readback.h"
#include "renderer/prepared_scene.h"
#include "renderer/slices.h"

namespace voxilux {

// What a frame is rendered from. It outlives the run.
struct FrameInputs {
    const PreparedScene& prepared;
    const RenderOptions& options;  // its own time limit
    const FilmStart& film;         // what the film holds already
    gpu::FrameParams params;
    bool is_cpu = true;
    std::chrono::steady_clock::time_point start;
    ErrorGuess guess;                // of the error, when there is a target
    std::vector<NoiseShare> shares;  // of the noise, as far as they are known
};

// What a frame calls while it runs.
struct FrameCalls {
    std::function<void(const Progress&)> on_progress;  // after a slice
    std::function<void()> save;                        // as often as RenderOptions::checkpoint_s says
    // With a time limit, once after the first sample: does to a strip of rows what will be done to the
    // picture.
    std::function<void(RenderOutcome strip)> rehearse;
};

// Takes the samples of one frame on a device that holds the world: all between the plan and the film.
class FrameRun {
  public:
    // Clears the film. `upload` holds what must be on the device before, when there is something new.
    FrameRun(const FrameInputs& inputs, Recording upload, Executor& executor, FrameState& state);

    // Renders until the frame is done or one of the options stops it.
    void run(const FrameCalls& calls);

    // What the film holds now: the picture, and the numbers that this class knows.
    [[nodiscard]] RenderOutcome outcome();

    // The errors that this frame itself has claimed so far.
    [[nodiscard]] std::vector<ErrorPoint> own_points() const;

  private:
    bool should_stop(const Slice& slice);
    bool is_done();
    ErrorEstimate measure_error();
    void measure_for_progress(const FrameCalls& calls);
    void rehearse_end(const FrameCalls& calls);
    [[nodiscard]] RenderOutcome strip_of(RowRange rows);
    void save_when_due(const std::function<void()>& save);
    [[nodiscard]] FilmSums with_start(FilmSums film) const;
    void add_outlook(RenderStatistics& statistics) const;
    [[nodiscard]] double seconds_per_sample() const;
    double render_slice(const Slice& slice);
    void add_tally(const RunResult& result, const Slice& slice);
    double add_times(const RunResult& result);
    void report_progress(const Slice& slice, const FrameCalls& calls);
    [[nodiscard]] FrameStand stand_after(const Slice& slice) const;

    const FrameInputs& inputs_;
    const RenderPlan& plan_;
    Executor& executor_;
    FrameState& state_;
    SliceGovernor governor_;
    std::vector<std::uint32_t> row_samples_;  // of the shard that each row has received
    RenderStatistics statistics_;
    std::vector<ErrorPoint> points_;
    std::optional<ErrorCurve> curve_;    // through them
    std::optional<ErrorRounds> rounds_;  // with an error target
    std::uint32_t looked_at_ = 0;        // samples, when the error was measured last
    double looked_s_ = 0.0;              // and when
    double sampling_s_ = 0.0;            // when the first sample began
    double row_s_ = 0.0;                 // per row, of the last slice
    double recent_s_ = 0.0;              // per sample, of the last ones
    double end_s_ = 0.0;                 // expected from the last sample to the end
    std::uint32_t sample_ = 0;           // that is being rendered, as the render counts them
    std::uint32_t first_row_ = 0;
    double samples_at_start_ = 0.0;
    double next_save_s_ = 0.0;
    double most_done_ = 0.0;  // that was told
};

}  // namespace voxilux
