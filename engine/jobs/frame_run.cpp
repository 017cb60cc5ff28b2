#include "jobs/frame_run.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "estimators/film_error.h"
#include "frame/frame.h"
#include "jobs/forecast.h"
#include "passes/upload.h"
#include "plan/error_law.h"
#include "shared/tally.h"

namespace voxilux {
namespace {

// Checkpoints of large pictures take seconds: the time between two is at least this many times as long.
constexpr double kLeastSavePause = 9.0;

// Reading the film costs about as much as one sample. For progress alone it is read when samples have doubled
// and this time has passed.
constexpr double kLookEvery_s = 2.0;
constexpr std::uint32_t kFirstLook = 8;

// The strip that tells how long the end of a render takes: a part of the picture, whole blocks of an EXR.
constexpr std::uint32_t kStripParts = 32;
constexpr std::uint32_t kLeastStripRows = 16;
constexpr double kEndMargin = 1.1;
// Another process may get in the way of a short one: the middle of so many, if there is time.
constexpr std::size_t kRehearsals = 3;
constexpr double kRehearsal_s = 0.1;
constexpr double kExit_s = 0.1;  // from the last file to the end of the process

constexpr double kRecentShare = 0.1;  // of a new sample in the mean time of the last ones

}  // namespace

FrameRun::FrameRun(const FrameInputs& inputs, Recording upload, Executor& executor, FrameState& state)
    : inputs_(inputs),
      plan_(inputs.prepared.plan),
      executor_(executor),
      state_(state),
      governor_(inputs.prepared.plan, inputs.is_cpu),
      row_samples_(static_cast<std::size_t>(inputs.prepared.plan.settings.size.y), inputs.film.samples),
      points_(inputs.guess.points),
      curve_(fit_error(error_law(plan_), points_)),
      first_row_(inputs.film.rows_ahead),
      next_save_s_(inputs.options.checkpoint_s) {
    std::fill_n(row_samples_.begin(), first_row_, inputs.film.samples + 1);
    statistics_.samples = inputs.film.samples;
    statistics_.work = inputs.film.work;
    statistics_.faults = inputs.film.faults;
    const double rows = static_cast<double>(first_row_) / static_cast<double>(row_samples_.size());
    samples_at_start_ = inputs.film.samples + rows;
    if (inputs.options.error_target)
        rounds_.emplace(error_law(plan_), *inputs.options.error_target, inputs.guess, plan_.samples(),
                        inputs.film.samples);
    record_film_clear(plan_, upload);
    (void)add_times(executor_.run(upload));
}

void FrameRun::run(const FrameCalls& calls) {
    sampling_s_ = seconds_since(inputs_.start);
    while (!is_done()) {
        const double before_s = seconds_since(inputs_.start);
        sample_ = plan_.shard.sample(statistics_.samples);
        const auto render = [&](const Slice& slice, double& max_ms) {
            if (should_stop(slice)) return false;
            const double slice_s = seconds_since(inputs_.start);
            max_ms = render_slice(slice);
            row_s_ = (seconds_since(inputs_.start) - slice_s) / slice.row_count;
            report_progress(slice, calls);
            save_when_due(calls.save);
            return true;
        };
        if (!governor_.for_each_slice(render, std::exchange(first_row_, 0))) return;
        const double sample_s = seconds_since(inputs_.start) - before_s;
        recent_s_ = recent_s_ > 0.0 ? recent_s_ + (sample_s - recent_s_) * kRecentShare : sample_s;
        ++statistics_.samples;
        state_.finish_sample(inputs_.params);
        if (end_s_ == 0.0) rehearse_end(calls);
        measure_for_progress(calls);
    }
}

// Whether the frame has all its samples. Their error is looked at where a round ends, and only there it
// decides.
bool FrameRun::is_done() {
    if (!rounds_ || statistics_.samples < rounds_->end()) return statistics_.samples >= plan_.samples();
    if (!rounds_->reaches(statistics_.samples, measure_error()))
        return statistics_.samples >= plan_.samples();
    statistics_.stop = StopReason::error_target;
    return true;
}

ErrorEstimate FrameRun::measure_error() {
    const ErrorEstimate error = error_of(with_start(read_error_film(plan_, executor_)));
    looked_at_ = statistics_.samples;
    looked_s_ = seconds_since(inputs_.start);
    if (const auto point = error_point(statistics_.samples, error)) points_.push_back(*point);
    curve_ = fit_error(error_law(plan_), points_);
    return error;
}

// What people are shown decides nothing.
void FrameRun::measure_for_progress(const FrameCalls& calls) {
    if (!calls.on_progress || plan_.any(&Technique::shares_samples)) return;
    const bool is_due = seconds_since(inputs_.start) - looked_s_ >= kLookEvery_s;
    if (is_due && statistics_.samples >= std::max(2 * looked_at_, kFirstLook)) (void)measure_error();
}

// How long reading, picture and files will take, by a strip from the middle of the picture. Checkpoints lie
// beside the picture, and are part of it.
void FrameRun::rehearse_end(const FrameCalls& calls) {
    if (!calls.rehearse || !inputs_.options.time_limit_s) return;
    const auto height = static_cast<std::uint32_t>(plan_.settings.size.y);
    const RowRange rows = middle_rows(plan_, std::max(kLeastStripRows, height / kStripParts));
    std::vector<double> seconds;
    const double start_s = seconds_since(inputs_.start);
    do {
        const double begin_s = seconds_since(inputs_.start);
        calls.rehearse(strip_of(rows));
        seconds.push_back(seconds_since(inputs_.start) - begin_s);
    } while (seconds.size() < kRehearsals && seconds_since(inputs_.start) - start_s < kRehearsal_s);
    std::ranges::sort(seconds);
    end_s_ = kEndMargin * seconds[seconds.size() / 2] * height / rows.count + kExit_s;
}

RenderOutcome FrameRun::strip_of(RowRange rows) {
    FilmSums film = read_film_rows(plan_, rows, executor_);
    std::ranges::fill(film.even, 1u);
    std::ranges::fill(film.odd, 1u);
    RenderOutcome strip{
        .image = picture_of(film), .plan = plan_of_rows(plan_, rows.count), .statistics = statistics_};
    strip.statistics.error = error_of(film);
    if (inputs_.options.keeps_film) strip.film = std::move(film);
    return strip;
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
    // Halves that share samples are not independent: they agree better than they are right.
    statistics.error = plan_.any(&Technique::shares_samples) ? unknown_error() : error_of(film);
    add_outlook(statistics);
    statistics.live_cells = state_.live_cells;
    statistics.memory = executor_.memory();
    statistics.pipelines = executor_.pipelines_created();
    statistics.samples = std::ranges::min(row_samples_);
    outcome.rows_ahead = static_cast<std::uint32_t>(
        std::ranges::count_if(row_samples_, [&](std::uint32_t n) { return n > statistics.samples; }));
    if (inputs_.options.keeps_film) outcome.film = std::move(film);
    return outcome;
}

std::vector<ErrorPoint> FrameRun::own_points() const {
    return {points_.begin() + static_cast<std::ptrdiff_t>(inputs_.guess.points.size()), points_.end()};
}

double FrameRun::seconds_per_sample() const {
    const double taken = statistics_.samples - samples_at_start_;
    return taken > 0.0 ? (seconds_since(inputs_.start) - sampling_s_) / taken : 0.0;
}

// What decided the end, and what a minute more would bring.
void FrameRun::add_outlook(RenderStatistics& statistics) const {
    if (statistics_.stop == StopReason::error_target) statistics.decided_by = rounds_->decided_by();
    if (rounds_) statistics.rounds = rounds_->rounds();
    std::vector<ErrorPoint> points = points_;
    if (const auto point = error_point(statistics_.samples, statistics.error)) points.push_back(*point);
    const auto curve = fit_error(error_law(plan_), points);
    const double pace = seconds_per_sample();
    if (!curve || pace <= 0.0 || !statistics.error.is_known()) return;
    statistics.next_minute = price_next_minute(*curve, statistics_.samples, pace, inputs_.shares);
}

// The first sample is always finished, so that the picture is whole. A slice that would end too late to write
// the picture in time is not begun.
bool FrameRun::should_stop(const Slice& slice) {
    if (inputs_.options.interrupted != nullptr && inputs_.options.interrupted->load()) {
        statistics_.stop = StopReason::interrupted;
        return true;
    }
    const double end_s = seconds_since(inputs_.start) + row_s_ * slice.row_count + end_s_;
    if (inputs_.options.time_limit_s && statistics_.samples > 0 && end_s >= *inputs_.options.time_limit_s) {
        statistics_.stop = StopReason::time_limit;
        return true;
    }
    return false;
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
    if (plan_.photons.runs()) statistics_.work["photons_emitted"] += plan_.photons.count();
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

FrameStand FrameRun::stand_after(const Slice& slice) const {
    const double rows = static_cast<double>(slice.first_row + slice.row_count);
    const double elapsed_s = seconds_since(inputs_.start);
    FrameStand stand{.start = samples_at_start_,
                     .samples = statistics_.samples + rows / static_cast<double>(row_samples_.size()),
                     .end = static_cast<double>(rounds_ ? rounds_->end() : plan_.samples()),
                     .sampling_s = elapsed_s - sampling_s_,
                     .recent_s = recent_s_,
                     .end_s = end_s_};
    stand.end_high = stand.end;
    if (rounds_ && curve_) {
        const auto most = samples_for(*curve_, *inputs_.options.error_target, kHighDeviations);
        stand.end_high = std::min(most.value_or(kMostSamples), plan_.samples());
    }
    if (inputs_.options.time_limit_s) stand.limit_left_s = *inputs_.options.time_limit_s - elapsed_s;
    return stand;
}

void FrameRun::report_progress(const Slice& slice, const FrameCalls& calls) {
    if (!calls.on_progress) return;
    const FrameStand stand = stand_after(slice);
    const FrameRest rest = estimate_rest(stand);
    most_done_ = std::max(most_done_, rest.done);  // another round is no step back
    Progress progress{.done = most_done_,
                      .elapsed_s = sampling_s_ + stand.sampling_s,
                      .remaining_s = rest.expected_s,
                      .remaining_low_s = rest.low_s,
                      .remaining_high_s = rest.high_s,
                      .sample = statistics_.samples + 1};
    if (curve_ && stand.samples >= 1.0) {
        const double pace = stand.sampling_s / (stand.samples - stand.start);
        const double end = std::min(stand.end, stand.samples + rest.expected_s / pace);
        progress.error = claimed_error(*curve_, stand.samples);
        progress.error_at_end = claimed_error(*curve_, std::max(end, stand.samples));
    }
    calls.on_progress(progress);
}

}  // namespace voxilux
