#include "session/frame_run.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "frame/frame.h"
#include "passes/upload.h"
#include "shared/tally.h"

namespace voxilux {
namespace {

// How often the error is estimated when it decides the end: reading the film costs about as much as one
// sample.
constexpr std::uint32_t kErrorCheckEvery = 8;

}  // namespace

FrameRun::FrameRun(const FrameInputs& inputs, Recording upload, Executor& executor, FrameState& state)
    : inputs_(inputs),
      plan_(inputs.prepared.plan),
      executor_(executor),
      state_(state),
      governor_(inputs.prepared.plan, inputs.is_cpu),
      row_samples_(static_cast<std::size_t>(inputs.prepared.plan.settings.size.y), 0) {
    record_film_clear(plan_, upload);
    (void)add_times(executor_.run(upload));
}

void FrameRun::run(const std::function<void(const Progress&)>& on_progress) {
    for (sample_ = 0; sample_ < plan_.settings.spp; ++sample_) {
        const bool whole = governor_.for_each_slice([&](const Slice& slice, double& max_ms) {
            if (should_stop()) return false;
            max_ms = render_slice(slice);
            report_progress(slice, on_progress);
            return true;
        });
        if (!whole) return;
        statistics_.samples = sample_ + 1;
        state_.finish_sample(inputs_.params);
        if (reached_error_target()) return;
    }
}

RenderStatistics FrameRun::finish(Image& image) {
    FilmReadback film = read_film(plan_, row_samples_, executor_);
    image = std::move(film.image);
    // Halves that share occlusion cells are not independent: they agree better than they are right.
    statistics_.error = plan_.has_ao_cells() ? unknown_error() : film.error;
    statistics_.live_cells = state_.live_cells;
    statistics_.memory = executor_.memory();
    statistics_.pipelines = executor_.pipelines_created();
    return std::move(statistics_);
}

bool FrameRun::should_stop() {
    if (inputs_.options.interrupted != nullptr && inputs_.options.interrupted->load()) {
        statistics_.stop = StopReason::interrupted;
        return true;
    }
    // The first sample is always finished, so that the picture is whole.
    if (inputs_.options.time_limit_s && sample_ > 0 &&
        seconds_since(inputs_.start) >= *inputs_.options.time_limit_s) {
        statistics_.stop = StopReason::time_limit;
        return true;
    }
    return false;
}

bool FrameRun::reached_error_target() {
    if (!inputs_.options.error_target || statistics_.samples % kErrorCheckEvery != 0) return false;
    last_error_ = read_error(plan_, row_samples_, executor_).high;
    if (*last_error_ > *inputs_.options.error_target) return false;
    statistics_.stop = StopReason::error_target;
    return true;
}

double FrameRun::render_slice(const Slice& slice) {
    Recording recording;
    record_frame(plan_, slice, inputs_.params, {sample_, state_}, recording);
    recording.readback("tally");
    const RunResult result = executor_.run(recording);
    const auto first = row_samples_.begin() + slice.first_row;
    std::fill(first, first + slice.row_count, sample_ + 1);
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

void FrameRun::report_progress(const Slice& slice,
                               const std::function<void(const Progress&)>& on_progress) const {
    if (!on_progress) return;
    Progress progress{.done = share_done(slice),
                      .elapsed_s = seconds_since(inputs_.start),
                      .sample = sample_ + 1,
                      .error = last_error_};
    progress.remaining_s = progress.elapsed_s * (1.0 - progress.done) / progress.done;
    on_progress(progress);
}

// The largest of three shares: of the samples; of the time limit; of the samples that the error target
// needs when the error falls with their square root.
double FrameRun::share_done(const Slice& slice) const {
    const double rows = static_cast<double>(slice.first_row + slice.row_count);
    const double samples = static_cast<double>(sample_) + rows / static_cast<double>(row_samples_.size());
    double share = samples / static_cast<double>(plan_.settings.spp);
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
