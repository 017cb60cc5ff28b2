#include "session/frame_run.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "frame/frame.h"
#include "passes/upload.h"
#include "session/film_readback.h"
#include "shared/tally.h"

namespace voxilux {
namespace {

// How often the error is estimated when it decides the end: reading the film costs about as much as one
// sample.
constexpr std::uint32_t kErrorCheckEvery = 8;

// Checkpoints of large pictures take seconds: the time between two is at least this many times as long.
constexpr double kLeastSavePause = 9.0;

}  // namespace

FrameRun::FrameRun(const FrameInputs& inputs, Recording upload, Executor& executor, FrameState& state)
    : inputs_(inputs),
      plan_(inputs.prepared.plan),
      executor_(executor),
      state_(state),
      governor_(inputs.prepared.plan, inputs.is_cpu),
      row_samples_(static_cast<std::size_t>(inputs.prepared.plan.settings.size.y), inputs.film.samples),
      first_row_(inputs.film.rows_ahead),
      next_save_s_(inputs.options.checkpoint_s) {
    std::fill_n(row_samples_.begin(), first_row_, inputs.film.samples + 1);
    statistics_.samples = inputs.film.samples;
    statistics_.work = inputs.film.work;
    statistics_.faults = inputs.film.faults;
    const double rows = static_cast<double>(first_row_) / static_cast<double>(row_samples_.size());
    share_at_start_ = (inputs.film.samples + rows) / plan_.samples();
    record_film_clear(plan_, upload);
    (void)add_times(executor_.run(upload));
}

void FrameRun::run(const OnProgress& on_progress, const std::function<void()>& save) {
    while (statistics_.samples < plan_.samples()) {
        sample_ = plan_.shard.sample(statistics_.samples);
        const auto render = [&](const Slice& slice, double& max_ms) {
            if (should_stop()) return false;
            max_ms = render_slice(slice);
            report_progress(slice, on_progress);
            save_when_due(save);
            return true;
        };
        if (!governor_.for_each_slice(render, std::exchange(first_row_, 0))) return;
        ++statistics_.samples;
        state_.finish_sample(inputs_.params);
        if (reached_error_target()) return;
    }
}

void FrameRun::save_when_due(const std::function<void()>& save) {
    const double start_s = seconds_since(inputs_.start);
    if (inputs_.options.checkpoint_s <= 0.0 || start_s < next_save_s_) return;
    save();
    const double end_s = seconds_since(inputs_.start);
    next_save_s_ = end_s + std::max(inputs_.options.checkpoint_s, kLeastSavePause * (end_s - start_s));
}

// The film of the device and what was there before.
FilmSums FrameRun::with_start(FilmSums film) const {
    const FilmSums& before = inputs_.film.sums;
    const bool is_empty = before.sums.empty();
    for (std::size_t row = 0; row < row_samples_.size(); ++row) {
        const std::uint32_t even = plan_.shard.even_samples(row_samples_[row]);
        film.even[row] = even - (is_empty ? 0 : before.even[row]);
        film.odd[row] = row_samples_[row] - even - (is_empty ? 0 : before.odd[row]);
    }
    if (is_empty) return film;
    FilmSums all{.width = before.width,
                 .height = before.height,
                 .is_independent = film.is_independent,
                 .even = before.even,
                 .odd = before.odd};
    for (const auto& [name, sums] : film.sums)
        all.sums[name] = before.sums.at(name);
    for (const auto& [name, values] : film.firsts)
        all.firsts[name] = before.firsts.at(name);
    add_film(all, film);
    return all;
}

RenderOutcome FrameRun::outcome() {
    FilmSums film = with_start(read_film(plan_, executor_));
    RenderOutcome outcome{.image = picture_of(film), .plan = plan_, .statistics = statistics_};
    RenderStatistics& statistics = outcome.statistics;
    // Halves that share occlusion cells are not independent: they agree better than they are right.
    statistics.error = plan_.has_ao_cells() ? unknown_error() : error_of(film);
    statistics.live_cells = state_.live_cells;
    statistics.memory = executor_.memory();
    statistics.pipelines = executor_.pipelines_created();
    statistics.samples = std::ranges::min(row_samples_);
    outcome.rows_ahead = static_cast<std::uint32_t>(
        std::ranges::count_if(row_samples_, [&](std::uint32_t n) { return n > statistics.samples; }));
    if (inputs_.options.keeps_film) outcome.film = std::move(film);
    return outcome;
}

bool FrameRun::should_stop() {
    if (inputs_.options.interrupted != nullptr && inputs_.options.interrupted->load()) {
        statistics_.stop = StopReason::interrupted;
        return true;
    }
    // The first sample is always finished, so that the picture is whole.
    if (inputs_.options.time_limit_s && statistics_.samples > 0 &&
        seconds_since(inputs_.start) >= *inputs_.options.time_limit_s) {
        statistics_.stop = StopReason::time_limit;
        return true;
    }
    return false;
}

bool FrameRun::reached_error_target() {
    if (!inputs_.options.error_target || statistics_.samples % kErrorCheckEvery != 0) return false;
    last_error_ = error_of(with_start(read_error_film(plan_, executor_))).high;
    if (*last_error_ > *inputs_.options.error_target) return false;
    statistics_.stop = StopReason::error_target;
    return true;
}

double FrameRun::render_slice(const Slice& slice) {
    Recording recording;
    record_frame(plan_, slice, inputs_.params, {sample_, state_, plan_.shard.index}, recording);
    recording.readback("tally");
    const RunResult result = executor_.run(recording);
    const auto first = row_samples_.begin() + slice.first_row;
    std::fill(first, first + slice.row_count, statistics_.samples + 1);
    if (statistics_.first_pixel_s == 0.0) statistics_.first_pixel_s = seconds_since(inputs_.start);
    add_tally(result, slice);
    return add_times(result);
}

void FrameRun::add_tally(const RunResult& result, const Slice& slice) {
    std::array<gpu::uint, gpu::kTallyCount> tally{};
    const std::vector<std::byte>& bytes = result.readbacks.at("tally");
    std::memcpy(tally.data(), bytes.data(), sizeof(tally));
    for (std::size_t i = 0; i < tally.size(); ++i) {
        auto& table = i < gpu::kFaultCount ? statistics_.faults : statistics_.work;
        table[gpu::kTallyNames[i]] += tally[i];
    }
    state_.live_cells += std::uint64_t{tally[gpu::kWorkAoClaimed]} - tally[gpu::kWorkAoEvicted];
    if (plan_.has_photons()) statistics_.work["photons_emitted"] += plan_.photons.count();
    if (plan_.rays.primary != 0)
        statistics_.work["primary_rays"] += std::uint64_t{inputs_.params.column_count} * slice.row_count;
}

double FrameRun::add_times(const RunResult& result) {
    double longest = 0.0;
    for (const PassTime& pass : result.passes) {
        auto known = std::ranges::find(statistics_.passes, pass.label, &PassTime::label);
        if (known == statistics_.passes.end()) known = statistics_.passes.insert(known, PassTime{pass.label});
        known->count += pass.count;
        known->ms += pass.ms;
        known->max_ms = std::max(known->max_ms, pass.max_ms);
        statistics_.gpu_ms += pass.ms;
        longest = std::max(longest, pass.max_ms);
    }
    return longest;
}

void FrameRun::report_progress(const Slice& slice, const OnProgress& on_progress) const {
    if (!on_progress) return;
    Progress progress{.done = share_done(slice),
                      .elapsed_s = seconds_since(inputs_.start),
                      .sample = statistics_.samples + 1,
                      .error = last_error_};
    progress.remaining_s = progress.elapsed_s * (1.0 - progress.done) / (progress.done - share_at_start_);
    on_progress(progress);
}

// The largest of three shares: of the samples; of the time limit; of the samples that the error target
// needs when the error falls with their square root.
double FrameRun::share_done(const Slice& slice) const {
    const double rows = static_cast<double>(slice.first_row + slice.row_count);
    const double samples =
        static_cast<double>(statistics_.samples) + rows / static_cast<double>(row_samples_.size());
    double share = samples / static_cast<double>(plan_.samples());
    if (inputs_.options.time_limit_s)
        share = std::max(share, seconds_since(inputs_.start) / *inputs_.options.time_limit_s);
    if (inputs_.options.error_target && last_error_) {
        const std::uint32_t checked = statistics_.samples / kErrorCheckEvery * kErrorCheckEvery;
        const double ratio = *inputs_.options.error_target / *last_error_;
        share = std::max(share, samples / checked * ratio * ratio);
    }
    return std::min(share, 1.0);
}

}  // namespace voxilux
