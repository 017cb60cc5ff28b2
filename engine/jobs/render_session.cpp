#include "jobs/render_session.h"

#include <sys/resource.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "frame/footprint.h"
#include "jobs/error_pilot.h"
#include "jobs/memory_forecast.h"
#include "jobs/memory_reserve.h"
#include "jobs/noise_shares.h"
#include "jobs/sample_loop.h"
#include "scene/scene_camera.h"
#include "world/world_view.h"

namespace voxilux {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_of(const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

void measure_process(RenderStatistics& statistics) {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    statistics.cpu_s = seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime);
    statistics.peak_rss_mib = static_cast<double>(usage.ru_maxrss) / 1024.0;
}

void add_passes(std::span<const PassTime> passes, RenderStatistics& statistics) {
    add_times(statistics.passes, passes);
    for (const PassTime& pass : passes)
        statistics.gpu_ms += pass.ms;
}

void warn_about_camera(const Scene& scene, const PreparedScene& prepared,
                       std::vector<std::string>& warnings) {
    const MarchWorld& march_world = prepared.march_world;
    const glm::ivec3 cell(glm::floor(camera_of(scene).position - glm::dvec3(march_world.origin)));
    if (!prepared.facts.has_voxels || gpu::is_outside(cell, march_world.size())) return;
    if (gpu::cell_state(gpu::find_cell(march_world, cell, march_world.chunks_size).cell) == gpu::kCellSolid)
        warnings.emplace_back(
            "the camera is inside a solid voxel: the picture shows its inside, which is dark");
}

// Fraction of a time limit that a pilot may take: its samples are not part of the image.
constexpr double kPilotTimeShare = 0.1;
// Seconds that measuring noise by effect may take, or kPilotShare of the render if that is more.
constexpr double kShareBudget_s = 1.0;

// A checkpoint is assumed, because whether there will be one is not known before the render.
constexpr double kAnyTime_s = std::numeric_limits<double>::infinity();

RenderOptions with_wishes(RenderOptions options) {
    options.plan.wants_error = options.error_target.has_value();
    return options;
}

Device open_timed(const DeviceRequest& request, std::vector<StepTime>& steps) {
    StepTimes times;
    Device device = open_device(request);
    times.end_step("device");
    add_step_times(steps, times.steps());
    return device;
}

}  // namespace

RenderSession::RenderSession(Scene scene, RenderOptions options)
    : options_(with_wishes(std::move(options))),
      player_(std::move(scene)),
      device_(open_timed(options_.device, options_.steps)),
      renderer_(std::in_place, device_, options_.executor) {}

RenderSession::~RenderSession() = default;

void RenderSession::change(const RenderSettings& settings, const PlanRequest& request) {
    player_.change_settings(settings);
    options_.plan = request;
    last_points_.reset();
    is_changed_ = true;
}

void RenderSession::load(Scene scene, const PlanRequest& request) {
    player_ = FramePlayer(std::move(scene));
    options_.plan = request;
    options_ = with_wishes(std::move(options_));
    options_.started = Clock::now();
    last_points_.reset();
    forecast_.reset();
    shares_.clear();
    has_started_ = false;
    is_changed_ = false;
    is_loaded_ = true;
}

// Prepares the renderer for the frame.
void RenderSession::show(std::int64_t frame) {
    scene_ = &player_.show(frame);
    const bool is_changed = std::exchange(is_changed_, false);
    if (std::exchange(is_loaded_, false)) return renderer_->prepare(*scene_, options_.plan);
    const bool is_another = player_.has_new_voxels() || player_.has_new_light();
    if (!is_another && scene_->camera) renderer_->set_camera(*scene_->camera);
    if (is_changed) renderer_->change(scene_->settings, options_.plan);
    if (is_another) renderer_->set_voxels(*scene_);
}

std::optional<ErrorPilot> RenderSession::run_pilot(const std::function<bool()>& stops) {
    const PreparedScene& prepared = renderer_->prepared();
    if (!options_.error_target || prepared.plan.any(&Technique::keeps_state)) return {};
    const bool is_cpu = device_.limits().is_cpu;
    ErrorPilot pilot = run_error_pilot({.prepared = prepared,
                                        .scene = *scene_,
                                        .error = *options_.error_target,
                                        .is_cpu = is_cpu,
                                        .stops = stops},
                                       renderer_->executor());
    const std::optional<Forecast> rough = make_forecast(pilot, *options_.error_target, {});
    if (!rough || !pilot.is_complete) return pilot;
    shares_ = share_noise({.prepared = prepared,
                           .scene = *scene_,
                           .is_cpu = is_cpu,
                           .sample_s = rough->expected_s / rough->samples,
                           .budget_s = std::max(kShareBudget_s, kPilotShare * rough->expected_s),
                           .stops = stops},
                          renderer_->executor());
    return pilot;
}

const RenderPlan& RenderSession::plan_of(std::int64_t frame) {
    show(frame);
    return plan();
}

std::optional<ErrorPilot> RenderSession::pilot(std::int64_t frame) {
    show(frame);
    return run_pilot({});
}

// The first frame has a pilot; later ones are expected to need what the one before did.
ErrorPrior RenderSession::error_prior(const RenderOptions& options, std::uint32_t samples_done,
                                      Clock::time_point start) {
    if (!options.error_target) return {};
    if (denoises() && !last_points_) return {};  // the pilot knows the noise of plain images
    if (last_points_) return {.points = *last_points_, .from = DecidedBy::frame_before};
    const auto stops = [&] {
        if (options.interrupted != nullptr && options.interrupted->load()) return true;
        return options.time_limit_s && seconds_since(start) > kPilotTimeShare * *options.time_limit_s;
    };
    const std::optional<ErrorPilot> pilot = run_pilot(stops);
    if (!pilot) return {};
    forecast_ = make_forecast(*pilot, *options.error_target,
                              {.max_samples = plan().samples(),
                               .samples_done = samples_done,
                               .pilot_s = seconds_since(start),
                               .film_values = film_values(plan()),
                               .time_limit_s = options.time_limit_s});
    return {.points = pilot->points, .from = DecidedBy::pilot};
}

RenderOutcome RenderSession::render(std::int64_t frame, std::optional<double> time_limit_s,
                                    const std::function<void(const Progress&)>& on_progress) {
    const Clock::time_point start = std::exchange(has_started_, true) ? Clock::now() : options_.started;
    show(frame);
    const double load_s = seconds_since(start);
    steps_before_ = std::exchange(options_.steps, {});
    RenderOptions options = options_;
    options.time_limit_s = time_limit_s;
    const bool is_first = !last_points_;
    const FilmStart film = options.resume ? options.resume(*scene_, plan(), device_.info()) : FilmStart{};
    std::vector<PassTime> looks;
    const FrameInputs inputs{.renderer = *renderer_,
                             .options = options,
                             .film = film,
                             .start = start,
                             .guess = error_prior(options, film.position.samples, start),
                             .shares = shares_,
                             .claim = claim_of_shown(looks)};
    SampleLoop loop(inputs);
    MemoryReserve reserve(end_bytes(plan(), picture_use(options, kAnyTime_s)), bytes_to_come());
    FrameCalls calls{.on_progress = on_progress, .save = [&] {
                         reserve.release();
                         options_.on_checkpoint(*scene_, [&] {
                             RenderOutcome so_far = loop.outcome();
                             complete(so_far, load_s, start);
                             return so_far;
                         });
                         reserve.take();
                     }};
    if (options_.rehearse_end)
        calls.rehearse = [&](RenderOutcome strip) {
            denoise(strip);
            options_.rehearse_end(*scene_, std::move(strip));
        };
    loop.run(calls);
    reserve.release();
    RenderOutcome outcome = loop.outcome();
    denoise(outcome);
    add_passes(looks, outcome.statistics);
    if (is_first) outcome.statistics.forecast = forecast_;
    last_points_ = loop.own_points();
    complete(outcome, load_s, start);
    outcome.statistics.validation = new_messages();
    return outcome;
}

// Parts are not denoised: they are no whole film, and nobody looks at their image.
bool RenderSession::denoises() const {
    return options_.plan.wants_denoised && plan().part.empty() && plan().is_denoised();
}

Denoised RenderSession::denoised(const FilmSums& film) {
    try {
        return denoise_film(film, renderer_->executor());
    } catch (const Error& error) {
        if (error.code() != ExitCode::out_of_memory) throw;
        return {.reason = error.what()};
    }
}

// An error target is one of the denoised image, where there will be one. `passes` gets the times of each
// look.
std::function<ErrorEstimate(const FilmSums&, const ErrorEstimate&)> RenderSession::claim_of_shown(
    std::vector<PassTime>& passes) {
    if (!denoises()) return {};
    return [&](const FilmSums& film, const ErrorEstimate& plain) {
        const Denoised look = denoised(film);
        add_times(passes, look.passes);
        return look.is_filtered() ? look.claim : plain;
    };
}

void RenderSession::denoise(RenderOutcome& outcome) {
    if (!options_.plan.wants_denoised || !outcome.plan.part.empty()) return;
    Denoised& result = outcome.denoised.emplace();
    if (!outcome.plan.is_denoised()) {
        const bool shares = outcome.plan.any(&Technique::shares_samples);
        result.reason = shares ? "pixels share occlusion samples" : kNoHalves;
        return;
    }
    VX_ASSERT(outcome.film.has_value());
    RenderStatistics& statistics = outcome.statistics;
    result = denoised(*outcome.film);
    result.claim = claim_with(result.claim, statistics.faults);
    statistics.memory = renderer_->executor().needed_memory();
    statistics.pipelines = renderer_->executor().pipelines_created();
    add_passes(result.passes, statistics);
}

// Host bytes that a software device has yet to allocate for this plan.
std::uint64_t RenderSession::bytes_to_come() {
    if (!device_.limits().is_cpu) return 0;
    std::uint64_t allocated = 0;
    for (const MemoryRow& row : renderer_->executor().memory())
        allocated += row.bytes;
    const std::uint64_t planned = footprint(plan()).total_bytes();
    return planned > allocated ? planned - allocated : 0;
}

// Adds what the sample loop does not know.
void RenderSession::complete(RenderOutcome& outcome, double load_s, Clock::time_point start) {
    RenderStatistics& statistics = outcome.statistics;
    statistics.device = device_.info();
    statistics.load_s = load_s;
    statistics.steps.insert(statistics.steps.begin(), steps_before_.begin(), steps_before_.end());
    statistics.warnings = scene_->warnings;
    warn_about_camera(*scene_, renderer_->prepared(), statistics.warnings);
    statistics.wall_s = seconds_since(start);
    measure_process(statistics);
}

std::vector<std::string> RenderSession::new_messages() {
    const std::vector<std::string> all = device_.messages();
    const auto first = all.begin() + static_cast<std::ptrdiff_t>(std::exchange(messages_told_, all.size()));
    return {first, all.end()};
}

std::vector<std::string> RenderSession::end() {
    renderer_.reset();
    return new_messages();
}

RenderOutcome render_scene(const Scene& scene, const RenderOptions& options,
                           const std::function<void(const Progress&)>& on_progress) {
    RenderSession session(scene, options);
    const std::int64_t frame = frames_of(scene).value_or(FrameRange{}).first;
    RenderOutcome outcome = session.render(frame, options.time_limit_s, on_progress);
    for (const std::string& message : session.end())
        outcome.statistics.validation.push_back(message);
    return outcome;
}

}  // namespace voxilux
