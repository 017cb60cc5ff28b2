#include "jobs/render_session.h"

#include <sys/resource.h>

#include <algorithm>
#include <utility>

#include "frame/footprint.h"
#include "jobs/error_pilot.h"
#include "jobs/frame_run.h"
#include "jobs/noise_shares.h"
#include "passes/upload.h"
#include "renderer/radius_pilot.h"
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

void warn_about_camera(const Scene& scene, const PreparedScene& prepared,
                       std::vector<std::string>& warnings) {
    const MarchWorld& march_world = prepared.march_world;
    const glm::ivec3 cell(glm::floor(camera_of(scene).position - glm::dvec3(march_world.origin)));
    if (!prepared.facts.has_voxels || gpu::is_outside(cell, march_world.size())) return;
    if (gpu::cell_state(gpu::find_cell(march_world, cell, march_world.chunks_size).cell) == gpu::kCellSolid)
        warnings.push_back("the camera is inside a solid voxel: the picture shows its inside, which is dark");
}

// Share of a time limit that a pilot may take: its samples are not in the picture.
constexpr double kPilotTimeShare = 0.1;
// What finding out whose noise it is may take, or kPilotShare of the render, if that is more.
constexpr double kShareBudget_s = 1.0;

RenderOptions with_error_wish(RenderOptions options) {
    options.plan.wants_error = options.error_target.has_value();
    return options;
}

}  // namespace

RenderSession::RenderSession(Scene scene, RenderOptions options)
    : options_(with_error_wish(std::move(options))),
      player_(std::move(scene)),
      device_(open_device(options_.device)),
      executor_(std::in_place, device_, pass_shaders(), options_.executor) {}

RenderSession::~RenderSession() = default;

// A scene without voxels counts its coordinates from a point near the camera, so that it is another world
// when the camera moves.
bool RenderSession::update_world(const Scene& scene) {
    const bool has_voxels = prepared_ && prepared_->facts.has_voxels;
    if (prepared_ && !player_.has_new_voxels() && has_voxels) return false;
    prepared_ = prepare_scene(scene, options_.plan, device_.limits());
    state_.change_world();
    return true;
}

void RenderSession::change(const RenderSettings& settings, const PlanRequest& request) {
    player_.change_settings(settings);
    options_.plan = request;
    first_radius_.reset();
    is_changed_ = true;
}

void RenderSession::replan(const Scene& scene, Recording& upload) {
    const bool had_voxels = prepared_->plan.has(Effect::voxels);
    const WorldFacts world = prepared_->plan.world;
    prepared_->plan = plan_within_memory(scene, prepared_->facts, world, options_.plan, device_.limits());
    state_ = {};
    if (!had_voxels)
        record_scene_upload(prepared_->plan, scene, prepared_->march_world, prepared_->lights, upload);
    else
        record_matter_upload(prepared_->plan, scene, prepared_->march_world.origin, prepared_->lights,
                             upload);
}

// What the device lacks for the frame.
Recording RenderSession::prepare(const Scene& scene) {
    Recording upload;
    const bool is_changed = std::exchange(is_changed_, false);
    if (update_world(scene))
        record_scene_upload(prepared_->plan, scene, prepared_->march_world, prepared_->lights, upload);
    else if (is_changed)
        replan(scene, upload);
    else
        return upload;
    if (prepared_->plan.needs_pilot()) choose_radius(std::exchange(upload, Recording{}));
    return upload;
}

// One radius for all frames, so that they do not flicker.
void RenderSession::choose_radius(const Recording& upload) {
    (void)executor_->run(upload);
    if (!first_radius_) first_radius_ = pilot_radius(*prepared_, *scene_, *executor_);
    prepared_->plan = plan_with_radius(prepared_->plan, *first_radius_);
}

std::optional<ErrorPilot> RenderSession::run_pilot(Recording& upload, const std::function<bool()>& stops) {
    if (!options_.error_target || prepared_->plan.any(&Technique::keeps_state)) return {};
    (void)executor_->run(std::exchange(upload, Recording{}));
    const bool is_cpu = device_.limits().is_cpu;
    ErrorPilot pilot = run_error_pilot({.prepared = *prepared_,
                                        .scene = *scene_,
                                        .error = *options_.error_target,
                                        .is_cpu = is_cpu,
                                        .stops = stops},
                                       *executor_);
    const std::optional<Forecast> rough = make_forecast(pilot, *options_.error_target, {});
    if (!rough || !pilot.is_complete) return pilot;
    shares_ = share_noise({.prepared = *prepared_,
                           .scene = *scene_,
                           .is_cpu = is_cpu,
                           .sample_s = rough->expected_s / rough->samples,
                           .budget_s = std::max(kShareBudget_s, kPilotShare * rough->expected_s),
                           .stops = stops},
                          *executor_);
    return pilot;
}

std::optional<ErrorPilot> RenderSession::pilot(std::int64_t frame) {
    scene_ = &player_.show(frame);
    Recording upload = prepare(*scene_);
    return run_pilot(upload, {});
}

// The first frame has a pilot; each later one is expected to need what the one before did.
ErrorGuess RenderSession::guess_error(Recording& upload, const RenderOptions& options,
                                      std::uint32_t samples_done, Clock::time_point start) {
    if (!options.error_target) return {};
    if (state_.frames_done > 0) return {.points = last_points_, .from = DecidedBy::frame_before};
    const auto stops = [&] {
        if (options.interrupted != nullptr && options.interrupted->load()) return true;
        return options.time_limit_s && seconds_since(start) > kPilotTimeShare * *options.time_limit_s;
    };
    const std::optional<ErrorPilot> pilot = run_pilot(upload, stops);
    if (!pilot) return {};
    forecast_ = make_forecast(*pilot, *options.error_target,
                              {.most_samples = prepared_->plan.samples(),
                               .samples_done = samples_done,
                               .pilot_s = seconds_since(start),
                               .film_values = film_values(prepared_->plan),
                               .time_limit_s = options.time_limit_s});
    return {.points = pilot->points, .from = DecidedBy::pilot};
}

RenderOutcome RenderSession::render(std::int64_t frame, std::optional<double> time_limit_s,
                                    const std::function<void(const Progress&)>& on_progress) {
    const Clock::time_point start = std::exchange(has_started_, true) ? Clock::now() : options_.started;
    scene_ = &player_.show(frame);
    Recording upload = prepare(*scene_);
    const double load_s = seconds_since(start);
    RenderOptions options = options_;
    options.time_limit_s = time_limit_s;
    const FilmStart film = options.resume ? options.resume(*scene_, prepared_->plan) : FilmStart{};
    const FrameInputs inputs{.prepared = *prepared_,
                             .options = options,
                             .film = film,
                             .params = frame_params(prepared_->plan, *scene_, prepared_->march_world),
                             .is_cpu = device_.limits().is_cpu,
                             .start = start,
                             .guess = guess_error(upload, options, film.samples, start),
                             .shares = shares_};
    FrameRun run(inputs, std::move(upload), *executor_, state_);
    FrameCalls calls{.on_progress = on_progress, .save = [&] {
                         RenderOutcome so_far = run.outcome();
                         complete(so_far, load_s, start);
                         options_.on_checkpoint(*scene_, std::move(so_far));
                     }};
    if (options_.rehearse_end)
        calls.rehearse = [&](RenderOutcome strip) { options_.rehearse_end(*scene_, std::move(strip)); };
    run.run(calls);
    RenderOutcome outcome = run.outcome();
    if (state_.frames_done == 0) outcome.statistics.forecast = forecast_;
    ++state_.frames_done;
    last_points_ = run.own_points();
    complete(outcome, load_s, start);
    outcome.statistics.validation = new_messages();
    return outcome;
}

// Adds what the run of the frame does not know.
void RenderSession::complete(RenderOutcome& outcome, double load_s, Clock::time_point start) {
    RenderStatistics& statistics = outcome.statistics;
    statistics.device = device_.info();
    statistics.load_s = load_s;
    statistics.warnings = scene_->warnings;
    warn_about_camera(*scene_, *prepared_, statistics.warnings);
    statistics.wall_s = seconds_since(start);
    measure_process(statistics);
}

std::vector<std::string> RenderSession::new_messages() {
    const std::vector<std::string> all = device_.messages();
    const auto first = all.begin() + static_cast<std::ptrdiff_t>(std::exchange(messages_told_, all.size()));
    return {first, all.end()};
}

std::vector<std::string> RenderSession::end() {
    executor_.reset();
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
