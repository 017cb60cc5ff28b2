#include "jobs/sample_loop.h"

#include <algorithm>
#include <cmath>

#include "estimators/film_error.h"
#include "jobs/forecast.h"
#include "plan/error_law.h"

namespace voxilux {
namespace {

// The strip on which the end of a render is timed: a fraction of the image, in whole blocks of an EXR.
constexpr std::uint32_t kStripParts = 32;
constexpr std::uint32_t kMinStripRows = 16;
constexpr double kEndMargin = 1.1;
// Other processes may disturb a short measurement: the median of up to this many, as time allows.
constexpr std::size_t kRehearsals = 3;
constexpr double kRehearsal_s = 0.1;
constexpr double kExit_s = 0.1;  // from the last file to the end of the process

// The sums on the device, added to those from before.
FilmSums added_to(const FilmSums& before, FilmSums film) {
    if (before.sums.empty()) return film;
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

std::uint32_t height_of(const RenderPlan& plan) {
    return static_cast<std::uint32_t>(plan.settings.size.y);
}

}  // namespace

SampleLoop::SampleLoop(const FrameInputs& inputs)
    : inputs_(inputs),
      watch_(error_law(inputs.renderer.plan()), inputs.guess.points),
      rule_(inputs.options, inputs.renderer.plan(), inputs.guess, inputs.film.position.samples),
      checkpoints_(inputs.options.checkpoint_s),
      clock_(inputs.start, inputs.film.position, height_of(inputs.renderer.plan())) {
    statistics_.work = inputs.film.work;
    statistics_.faults = inputs.film.faults;
    inputs.renderer.restart(inputs.film.position);
    (void)inputs.renderer.ready_film();  // uploads do not count as part of a sample
}

void SampleLoop::run(const FrameCalls& calls) {
    clock_.begin_sampling();
    bool knows_end = !calls.rehearse || !inputs_.options.time_limit_s;
    while (!rule_.is_done(samples(), [&] { return measure_error(); })) {
        const double begin_s = clock_.now_s();
        if (!take_sample(calls)) break;
        clock_.end_sample(begin_s);
        if (!std::exchange(knows_end, true)) rehearse_end(calls.rehearse);
        const bool shows_error =
            calls.on_progress && !inputs_.renderer.plan().any(&Technique::shares_samples);
        if (shows_error && watch_.is_due(samples(), clock_.now_s())) (void)measure_error();
    }
    statistics_.stop = rule_.reason();
}

// False when it was stopped early.
bool SampleLoop::take_sample(const FrameCalls& calls) {
    Renderer& renderer = inputs_.renderer;
    for (bool has_ended = false; !has_ended;) {
        const std::uint32_t rows = renderer.film().next_tile().row_count;
        const double begin_s = clock_.now_s();
        if (rule_.stops_before(begin_s + clock_.row_s() * rows, samples())) return false;
        const StepResult step = renderer.step_tile();
        add_step(step, renderer.plan(), statistics_);
        if (statistics_.first_pixel_s == 0.0) statistics_.first_pixel_s = clock_.now_s();
        clock_.end_slice(begin_s, rows);
        report_progress(calls.on_progress);
        const double save_s = clock_.now_s();
        if (checkpoints_.is_due(save_s) || is_checkpoint_wanted()) {
            calls.save();
            checkpoints_.saved(save_s, clock_.now_s());
        }
        has_ended = step.samples > 0;
    }
    return true;
}

bool SampleLoop::is_checkpoint_wanted() const {
    std::atomic<bool>* const wanted = inputs_.options.checkpoint_wanted;
    return wanted != nullptr && inputs_.options.keeps_film && wanted->exchange(false);
}

// A look at the denoised image takes no longer than the end of the render.
bool SampleLoop::has_time_to_look() const {
    const auto limit_s = rule_.time_limit_s();
    return !inputs_.claim || !limit_s || clock_.now_s() + 2.0 * rule_.kept_s() < *limit_s;
}

ErrorEstimate SampleLoop::measure_error() {
    if (!has_time_to_look()) return unknown_error();
    FilmSteps& steps = inputs_.renderer.ready_film();
    const FilmSums film = added_to(inputs_.film.sums, inputs_.claim ? steps.read() : steps.read_for_error());
    ErrorEstimate error = claimed_error_of(film, statistics_.faults);
    if (inputs_.claim) error = claim_with(inputs_.claim(film, error), statistics_.faults);
    watch_.add(samples(), error, clock_.now_s());
    return error;
}

// Predicts how long reading, image and files will take, from a strip in the middle of the image. Checkpoints
// are written beside the image and count as part of it.
void SampleLoop::rehearse_end(const std::function<void(RenderOutcome)>& rehearse) {
    const RenderPlan& plan = inputs_.renderer.plan();
    const RowRange rows = middle_rows(plan, std::max(kMinStripRows, height_of(plan) / kStripParts));
    const auto rehearse_once = [&] {
        FilmSums film = inputs_.renderer.ready_film().read_rows(rows);
        std::ranges::fill(film.even, 1u);
        std::ranges::fill(film.odd, 1u);
        RenderOutcome strip{
            .image = picture_of(film), .plan = plan_of_rows(plan, rows.count), .statistics = statistics_};
        strip.statistics.samples = samples();
        strip.statistics.error = error_of(film);
        if (inputs_.options.needs_film()) strip.film = std::move(film);
        rehearse(std::move(strip));
    };
    if (plan.sums_guides) rehearse_once();  // creates the pipelines of the denoiser
    std::vector<double> seconds;
    const double start_s = clock_.now_s();
    do {
        const double begin_s = clock_.now_s();
        rehearse_once();
        seconds.push_back(clock_.now_s() - begin_s);
    } while (seconds.size() < kRehearsals && clock_.now_s() - start_s < kRehearsal_s);
    std::ranges::sort(seconds);
    rule_.keep_for_end(kEndMargin * seconds[seconds.size() / 2] * height_of(plan) / rows.count + kExit_s);
}

RenderOutcome SampleLoop::outcome() {
    Renderer& renderer = inputs_.renderer;
    const RenderPlan& plan = renderer.plan();
    FilmSums film = added_to(inputs_.film.sums, renderer.read_film());
    RenderOutcome outcome{.image = picture_of(film), .plan = plan, .statistics = statistics_};
    RenderStatistics& statistics = outcome.statistics;
    // Halves that share samples are not independent: their difference underestimates the error.
    statistics.error =
        plan.any(&Technique::shares_samples) ? unknown_error() : claimed_error_of(film, statistics_.faults);
    statistics.samples = samples();
    add_projection(statistics);
    statistics.live_cells = renderer.film().state().live_cells;
    statistics.memory = renderer.executor().needed_memory();
    statistics.pipelines = renderer.executor().pipelines_created();
    outcome.rows_ahead = renderer.film().position().rows_ahead;
    if (inputs_.options.needs_film()) outcome.film = std::move(film);
    return outcome;
}

// What decided the end, and what one more minute would improve.
void SampleLoop::add_projection(RenderStatistics& statistics) const {
    if (rule_.rounds()) statistics.rounds = rule_.rounds()->rounds();
    if (statistics.stop == StopReason::error_target) statistics.decided_by = rule_.rounds()->decided_by();
    if (inputs_.claim) return;  // how fast that error falls depends on the image
    const auto curve = watch_.curve_with(statistics.samples, statistics.error);
    const double taken = statistics.samples - clock_.first_samples();
    if (!curve || taken <= 0.0 || !statistics.error.is_known()) return;
    statistics.next_minute =
        price_next_minute(*curve, statistics.samples, clock_.sampling_s() / taken, inputs_.shares);
}

FrameProgress SampleLoop::stand() const {
    FrameProgress stand{.start = clock_.first_samples(),
                        .samples = clock_.samples_at(inputs_.renderer.film().position()),
                        .end = static_cast<double>(rule_.end()),
                        .sampling_s = clock_.sampling_s(),
                        .recent_s = clock_.recent_s(),
                        .end_s = rule_.kept_s()};
    stand.end_high = stand.end;
    if (rule_.rounds() && watch_.curve()) {
        const auto most = samples_for(*watch_.curve(), *inputs_.options.error_target, kHighDeviations);
        stand.end_high = std::min(most.value_or(kMaxSamples), inputs_.renderer.plan().samples());
    }
    if (rule_.time_limit_s()) stand.limit_left_s = *rule_.time_limit_s() - clock_.now_s();
    return stand;
}

void SampleLoop::report_progress(const std::function<void(const Progress&)>& on_progress) {
    if (!on_progress) return;
    const FrameProgress now = stand();
    const RemainingTime rest = estimate_remaining(now);
    max_done_ = std::max(max_done_, rest.done);  // a new round must not step back
    Progress progress{.done = max_done_,
                      .elapsed_s = clock_.now_s(),
                      .remaining_s = rest.expected_s,
                      .remaining_low_s = rest.low_s,
                      .remaining_high_s = rest.high_s,
                      .sample = static_cast<std::uint32_t>(std::ceil(now.samples))};
    if (const auto& curve = watch_.curve(); curve && now.samples >= 1.0) {
        const double per_sample_s = now.sampling_s / (now.samples - now.start);
        const double end = std::min(now.end, now.samples + rest.expected_s / per_sample_s);
        progress.error = claimed_error(*curve, now.samples);
        progress.error_at_end = claimed_error(*curve, std::max(end, now.samples));
    }
    on_progress(progress);
}

}  // namespace voxilux
