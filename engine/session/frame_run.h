#pragma once

#include <chrono>
#include <functional>

#include "frame/frame_state.h"
#include "session/film_readback.h"
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
    gpu::FrameParams params;
    bool is_cpu = true;
    std::chrono::steady_clock::time_point start;
};

// Takes the samples of one frame on a device that holds the world: all between the plan and the film.
class FrameRun {
  public:
    // Clears the film. `upload` holds what must be on the device before, when there is something new.
    FrameRun(const FrameInputs& inputs, Recording upload, Executor& executor, FrameState& state);

    // Renders until the frame is done or one of the options stops it.
    void run(const std::function<void(const Progress&)>& on_progress);

    // The picture, and the numbers that this class knows.
    [[nodiscard]] RenderStatistics finish(Image& image);

  private:
    bool should_stop();
    bool reached_error_target();
    double render_slice(const Slice& slice);
    void add_tally(const RunResult& result, const Slice& slice);
    double add_times(const RunResult& result);
    void report_progress(const Slice& slice, const std::function<void(const Progress&)>& on_progress) const;
    [[nodiscard]] double share_done(const Slice& slice) const;

    const FrameInputs& inputs_;
    const RenderPlan& plan_;
    Executor& executor_;
    FrameState& state_;
    SliceGovernor governor_;
    RowSamples row_samples_;
    RenderStatistics statistics_;
    std::optional<double> last_error_;
    std::uint32_t sample_ = 0;
};

}  // namespace voxilux
