#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/step_times.h"
#include "film/film_sums.h"
#include "frame/frame_state.h"
#include "passes/display/display.h"
#include "renderer/dispatch_tiles.h"
#include "renderer/film_readback.h"
#include "shared/counters.h"
#include "vk/executor.h"

namespace voxilux {

// How far a film has come.
struct FilmPosition {
    std::uint32_t samples = 0;     // whole ones, of the plan's part
    std::uint32_t rows_ahead = 0;  // rows from the top that have one more

    bool operator==(const FilmPosition&) const = default;

    [[nodiscard]] std::uint32_t samples_of_row(std::uint32_t row) const {
        return samples + (row < rows_ahead ? 1 : 0);
    }
};

// For FilmSteps::step: only the time ends it.
inline constexpr std::uint32_t kNoEnd = 0xFFFFFFFF;

// What was done in a step.
struct StepResult {
    std::uint32_t tiles = 0;
    std::uint32_t samples = 0;  // of the whole image that were completed
    std::uint64_t pixels = 0;   // that got a sample
    std::array<std::uint64_t, gpu::kCounterCount> counters{};
    std::vector<PassTime> passes;
    std::vector<StepTime> built;  // what making and uploading worlds took since the step before
};

// Takes samples of one plan, tile by tile, on a device that holds the world: the only loop over dispatch
// tiles.
class FilmSteps {
  public:
    // The plan and the executor must outlive this. `state` is what earlier frames left on the device.
    FilmSteps(const RenderPlan& plan, Executor& executor, bool is_cpu, const FrameState& state = {});

    // Begins a frame. Its film starts empty on the device, at the position `start`; the caller keeps the
    // samples before that.
    void start_frame(const gpu::FrameParams& params, FilmPosition start = {});

    // The next tile that step_tile would take, or that a step with so many seconds left would.
    [[nodiscard]] DispatchTile next_tile() const { return governor_.tile_at(position_.rows_ahead); }
    [[nodiscard]] DispatchTile next_tile(double budget_s) const;

    // Renders one tile, as large as one dispatch should be.
    StepResult step_tile();

    // Renders at least one tile, and more until `budget_s` is over or `end_samples` samples are complete. It
    // starts no further tile that is expected to end after the budget.
    StepResult step(double budget_s, std::uint32_t end_samples = kNoEnd);

    // Renders this tile, which begins at position(), without clearing the film, and adds what it did to
    // `done`. `kept`: buffers to read back afterwards.
    RunResult take(const DispatchTile& tile, StepResult& done, std::span<const std::string> kept = {});

    // The film as it is displayed, in a buffer on the device. The frame must have begun with the first
    // sample.
    DisplayBuffer display(const DisplayLook& look);

    // The film of this frame with the sample counts of its rows; the second one only with the planes that the
    // error is estimated from.
    [[nodiscard]] FilmSums read();
    [[nodiscard]] FilmSums read_for_error();
    // Some rows, all in one film tile.
    [[nodiscard]] FilmSums read_rows(RowRange rows);

    [[nodiscard]] FilmPosition position() const { return position_; }
    // What this frame, as far as it has come, leaves to the next one.
    [[nodiscard]] FrameState state() const;

  private:
    void clear_film();
    DisplayBuffer record_display(DisplayLook look, Recording& recording) const;
    [[nodiscard]] FilmSums counted(FilmSums film, std::uint32_t first_row = 0) const;

    const RenderPlan* plan_;
    Executor* executor_;
    TileGovernor governor_;
    FrameState state_;
    gpu::FrameParams params_{};
    FilmPosition start_;
    FilmPosition position_;
    bool is_cleared_ = false;
    double row_s_ = 0.0;  // of the last tile, per row
};

}  // namespace voxilux
