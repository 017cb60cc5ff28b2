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

// Of FilmSteps::step: only the time ends it.
inline constexpr std::uint32_t kNoEnd = 0xFFFFFFFF;

// What was done in a step.
struct StepResult {
    std::uint32_t tiles = 0;
    std::uint32_t samples = 0;  // of the whole image that ended
    std::uint64_t pixels = 0;   // that got a sample
    std::array<std::uint64_t, gpu::kCounterCount> counters{};
    std::vector<PassTime> passes;
    std::vector<StepTime> built;  // what making and uploading worlds took since the step before
};

// Takes samples of one plan, tile by tile, on a device that holds the world: the one loop over tiles.
class FilmSteps {
  public:
    // The plan and the executor outlive this. `state` is what earlier frames left on the device.
    FilmSteps(const RenderPlan& plan, Executor& executor, bool is_cpu, const FrameState& state = {});

    // Begins a frame. Its film is empty on the device and goes on from `start`: what it held until then is
    // the caller's.
    void start_frame(const gpu::FrameParams& params, FilmPosition start = {});

    // The next tile that step_tile would take, or one that a step would take in so many seconds.
    [[nodiscard]] DispatchTile next_tile() const { return governor_.tile_at(position_.rows_ahead); }
    [[nodiscard]] DispatchTile next_tile(double budget_s) const;

    // Renders one tile, as large as the device should take at once.
    StepResult step_tile();

    // Renders tiles until `budget_s` is over: one at least, and no other that is expected to end later, nor
    // any after the sample that makes `end_samples` whole ones.
    StepResult step(double budget_s, std::uint32_t end_samples = kNoEnd);

    // Renders this tile, which begins at the position, into a film that need not be empty; what it did is
    // added to `done`. `kept`: buffers to read back when it is rendered.
    RunResult take(const DispatchTile& tile, StepResult& done, std::span<const std::string> kept = {});

    // The film as it is shown, in a buffer on the device. It has to begin with the first sample.
    DisplayBuffer display(const DisplayLook& look);

    // The film of this frame with the samples of its rows; the second one without what no error needs.
    [[nodiscard]] FilmSums read();
    [[nodiscard]] FilmSums read_for_error();
    // Some rows, all in one film tile.
    [[nodiscard]] FilmSums read_rows(RowRange rows);

    [[nodiscard]] FilmPosition position() const { return position_; }
    // What this frame, as far as it is, leaves to the next one.
    [[nodiscard]] FrameState state() const;

  private:
    void clear_film();
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
