#include "renderer/film_steps.h"

#include <algorithm>

#include "base/clock.h"
#include "frame/frame.h"
#include "passes/upload.h"

namespace voxilux {
namespace {

using Clock = std::chrono::steady_clock;

// Rows of the first tile, while the time of a row is unknown.
constexpr std::uint32_t kFirstRows = 16;

}  // namespace

FilmSteps::FilmSteps(const RenderPlan& plan, Executor& executor, bool is_cpu, const FrameState& state)
    : plan_(&plan), executor_(&executor), governor_(plan, is_cpu), state_(state) {}

void FilmSteps::start_frame(const gpu::FrameParams& params, FilmPosition start) {
    state_ = state();
    params_ = params;
    start_ = position_ = start;
    is_cleared_ = false;
}

FrameState FilmSteps::state() const {
    FrameState state = state_;
    if (position_ != start_) ++state.frames_done;
    return state;
}

void FilmSteps::clear_film() {
    if (std::exchange(is_cleared_, true)) return;
    Recording recording;
    record_film_clear(*plan_, recording);
    (void)executor_->run(recording);
}

DispatchTile FilmSteps::next_tile(double budget_s) const {
    const double rows = row_s_ > 0.0 ? std::clamp(budget_s / row_s_, 1.0, 1e6) : kFirstRows;
    return governor_.tile_at(position_.rows_ahead, static_cast<std::uint32_t>(rows));
}

StepResult FilmSteps::step_tile() {
    clear_film();
    StepResult done;
    (void)take(next_tile(), done);
    return done;
}

StepResult FilmSteps::step(double budget_s, std::uint32_t end_samples) {
    const auto start = Clock::now();
    clear_film();
    StepResult done;
    DispatchTile next = next_tile(budget_s);
    double left_s = budget_s;
    do {
        (void)take(next, done);
        left_s = budget_s - seconds_since(start);
        next = next_tile(left_s);
    } while (position_.samples < end_samples && row_s_ * next.row_count <= left_s);
    return done;
}

RunResult FilmSteps::take(const DispatchTile& tile, StepResult& done, std::span<const std::string> kept) {
    VX_ASSERT_EQ(tile.first_row, position_.rows_ahead);
    const auto start = Clock::now();
    Recording recording;
    record_frame(*plan_, tile, params_, {plan_->part.sample(position_.samples), state_, plan_->part.first()},
                 recording);
    recording.readback("counters");
    for (const std::string& buffer : kept)
        recording.readback(buffer);
    RunResult result = executor_->run(recording);
    row_s_ = seconds_since(start) / tile.row_count;
    double max_ms = 0.0;
    for (const PassTime& pass : result.passes)
        max_ms = std::max(max_ms, pass.max_ms);
    governor_.adapt(tile.row_count, max_ms);

    const auto counted = values_of<gpu::uint>(result, "counters");
    for (std::size_t i = 0; i < gpu::kCounterCount; ++i)
        done.counters[i] += counted[i];
    state_.live_cells += std::uint64_t{counted[gpu::kWorkAoClaimed]} - counted[gpu::kWorkAoEvicted];
    add_times(done.passes, result.passes);
    done.pixels += std::uint64_t{params_.column_count} * tile.row_count;
    ++done.tiles;
    position_.rows_ahead += tile.row_count;
    if (position_.rows_ahead < static_cast<std::uint32_t>(plan_->settings.size.y)) return result;
    position_ = {position_.samples + 1, 0};
    state_.finish_sample(params_);
    ++done.samples;
    return result;
}

FilmSums FilmSteps::counted(FilmSums film, std::uint32_t first_row) const {
    // Rows from the top may be one sample ahead.
    const auto even = [&](FilmPosition position) {
        const SampleSet& part = plan_->part;
        return std::array{part.even_samples(position.samples), part.even_samples(position.samples + 1)};
    };
    const auto before = even(start_);
    const auto now = even(position_);
    for (std::uint32_t i = 0; i < film.even.size(); ++i) {
        const std::uint32_t row = first_row + i;
        film.even[i] = now[row < position_.rows_ahead ? 1 : 0] - before[row < start_.rows_ahead ? 1 : 0];
        film.odd[i] = position_.samples_of_row(row) - start_.samples_of_row(row) - film.even[i];
    }
    return film;
}

DisplayBuffer FilmSteps::display(const DisplayLook& look) {
    VX_ASSERT(start_ == FilmPosition{});
    clear_film();
    Recording recording;
    const DisplayBuffer shown = record_display(look, recording);
    (void)executor_->run(recording);
    return shown;
}

DisplayBuffer FilmSteps::record_display(DisplayLook look, Recording& recording) const {
    if (look.channel == DisplayChannel::steps) return record_display_steps(*plan_, params_, look, recording);
    if (look.channel == DisplayChannel::cells && state_.samples_done > 0)
        return record_display_cells(*plan_, state_.samples_done - 1, look, recording);
    if (look.channel == DisplayChannel::cells) look.channel = DisplayChannel::color;  // there are none yet
    return record_display_resolve(*plan_, {position_.samples, position_.rows_ahead}, look, recording);
}

FilmSums FilmSteps::read() {
    clear_film();
    return counted(read_film(*plan_, *executor_));
}

FilmSums FilmSteps::read_for_error() {
    clear_film();
    return counted(read_error_film(*plan_, *executor_));
}

FilmSums FilmSteps::read_rows(RowRange rows) {
    clear_film();
    return counted(read_film_rows(*plan_, rows, *executor_), rows.first);
}

}  // namespace voxilux
