#pragma once

#include <chrono>
#include <functional>

#include "film/film_sums.h"
#include "frame/frame_state.h"
#include "session/prepared_scene.h"
#include "session/render_session.h"
#include "session/slices.h"

namespace voxilux {

[[nodiscard]] inline double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// What a frame is rendered from. It outlives the run.
struct FrameInputs {
    const PreparedScene& prepared;
    const RenderOptions& options;  // its own time limit
    const FilmStart& film;         // what the film holds already
    gpu::FrameParams params;
    bool is_cpu = true;
    std::chrono::steady_clock::time_point start;
};

// Takes the samples of one frame on a device that holds the world: all between the plan and the film.
class FrameRun {
  public:
    // Clears the film. `upload` holds what must be on the device before, when there is something new.
    FrameRun(const FrameInputs& inputs, Recording upload, Executor& executor, FrameState& state);

    // Called after a slice and while the film may be read.
    using OnProgress = std::function<void(const Progress&)>;

    // Renders until the frame is done or one of the options stops it. `save` is called as often as
    // RenderOptions::checkpoint_s says.
    void run(const OnProgress& on_progress, const std::function<void()>& save);

    // What the film holds now: the picture, and the numbers that this class knows.
    [[nodiscard]] RenderOutcome outcome();

  private:
    bool should_stop();
    bool reached_error_target();
    void save_when_due(const std::function<void()>& save);
    [[nodiscard]] FilmSums with_start(FilmSums film) const;
    double render_slice(const Slice& slice);
    void add_tally(const RunResult& result, const Slice& slice);
    double add_times(const RunResult& result);
    void report_progress(const Slice& slice, const OnProgress& on_progress) const;
    [[nodiscard]] double share_done(const Slice& slice) const;

    const FrameInputs& inputs_;
    const RenderPlan& plan_;
    Executor& executor_;
    FrameState& state_;
    SliceGovernor governor_;
    std::vector<std::uint32_t> row_samples_;  // of the shard that each row has received
    RenderStatistics statistics_;
    std::optional<double> last_error_;
    std::uint32_t sample_ = 0;  // that is being rendered, as the render counts them
    std::uint32_t first_row_ = 0;
    double share_at_start_ = 0.0;
    double next_save_s_ = 0.0;
};

}  // namespace voxilux
