#include "session/render_session.h"

#include <sys/resource.h>

#include <algorithm>
#include <chrono>

#include "frame/frame.h"
#include "passes/upload.h"
#include "plan/choose_traversal.h"
#include "scene/scene_camera.h"
#include "session/film_readback.h"
#include "session/slices.h"
#include "shared/tally.h"
#include "world/world_view.h"

namespace voxilux {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

double seconds_of(const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

// How often the error is estimated when it decides the end: reading the film costs about as much as one
// sample.
constexpr std::uint32_t kErrorCheckEvery = 8;

// The state of one render: everything between the plan and the film.
class RenderRun {
  public:
    RenderRun(const Scene& scene, const PreparedScene& prepared, const RenderOptions& options, Device& device,
              Clock::time_point start)
        : options_(options),
          plan_(prepared.plan),
          params_(frame_params(prepared.plan, scene, prepared.march_world)),
          executor_(device, pass_shaders(), options.executor),
          governor_(prepared.plan, device.limits().is_cpu),
          row_samples_(static_cast<std::size_t>(prepared.plan.settings.size.y), 0),
          start_(start) {
        Recording recording;
        record_scene_upload(plan_, scene, prepared.march_world, recording);
        record_film_clear(plan_, recording);
        (void)add_times(executor_.run(recording));
    }

    void run(const std::function<void(const Progress&)>& on_progress) {
        for (sample_ = 0; sample_ < plan_.settings.spp; ++sample_) {
            const bool whole = governor_.for_each_slice([&](const Slice& slice, double& max_ms) {
                if (should_stop()) return false;
                max_ms = render_slice(slice);
                report_progress(slice, on_progress);
                return true;
            });
            if (!whole) return;
            statistics_.samples = sample_ + 1;
            state_.finish_sample(params_);
            if (reached_error_target()) return;
        }
    }

    RenderStatistics finish(Image& image) {
        FilmReadback film = read_film(plan_, row_samples_, executor_);
        image = std::move(film.image);
        statistics_.error = film.error;
        statistics_.memory = executor_.memory();
        statistics_.pipelines = executor_.pipelines_created();
        return std::move(statistics_);
    }

  private:
    bool should_stop() {
        if (options_.interrupted != nullptr && options_.interrupted->load()) {
            statistics_.stop = StopReason::interrupted;
            return true;
        }
        // The first sample is always finished, so that the picture is whole.
        if (options_.time_limit_s && sample_ > 0 && seconds_since(start_) >= *options_.time_limit_s) {
            statistics_.stop = StopReason::time_limit;
            return true;
        }
        return false;
    }

    bool reached_error_target() {
        if (!options_.error_target || statistics_.samples % kErrorCheckEvery != 0) return false;
        last_error_ = read_error(plan_, row_samples_, executor_).high;
        if (*last_error_ > *options_.error_target) return false;
        statistics_.stop = StopReason::error_target;
        return true;
    }

    double render_slice(const Slice& slice) {
        Recording recording;
        record_frame(plan_, slice, params_, {sample_, state_}, recording);
        recording.readback("tally");
        const RunResult result = executor_.run(recording);
        const auto first = row_samples_.begin() + slice.first_row;
        std::fill(first, first + slice.row_count, sample_ + 1);
        if (statistics_.first_pixel_s == 0.0) statistics_.first_pixel_s = seconds_since(start_);
        add_tally(result, slice);
        return add_times(result);
    }

    void add_tally(const RunResult& result, const Slice& slice) {
        std::array<gpu::uint, gpu::kTallyCount> tally{};
        const std::vector<std::byte>& bytes = result.readbacks.at("tally");
        std::memcpy(tally.data(), bytes.data(), sizeof(tally));
        for (std::size_t i = 0; i < tally.size(); ++i) {
            auto& table = i < gpu::kFaultCount ? statistics_.faults : statistics_.work;
            table[gpu::kTallyNames[i]] += tally[i];
        }
        if (plan_.rays.primary != 0)
            statistics_.work["primary_rays"] += std::uint64_t{params_.column_count} * slice.row_count;
    }

    double add_times(const RunResult& result) {
        double longest = 0.0;
        for (const PassTime& pass : result.passes) {
            auto known = std::ranges::find(statistics_.passes, pass.label, &PassTime::label);
            if (known == statistics_.passes.end())
                known = statistics_.passes.insert(known, PassTime{pass.label});
            known->count += pass.count;
            known->ms += pass.ms;
            known->max_ms = std::max(known->max_ms, pass.max_ms);
            statistics_.gpu_ms += pass.ms;
            longest = std::max(longest, pass.max_ms);
        }
        return longest;
    }

    void report_progress(const Slice& slice, const std::function<void(const Progress&)>& on_progress) const {
        if (!on_progress) return;
        Progress progress{.done = share_done(slice),
                          .elapsed_s = seconds_since(start_),
                          .sample = sample_ + 1,
                          .error = last_error_};
        progress.remaining_s = progress.elapsed_s * (1.0 - progress.done) / progress.done;
        on_progress(progress);
    }

    // The largest of three shares: of the samples; of the time limit; of the samples that the error target
    // needs when the error falls with their square root.
    double share_done(const Slice& slice) const {
        const double rows = static_cast<double>(slice.first_row + slice.row_count);
        const double samples = static_cast<double>(sample_) + rows / static_cast<double>(row_samples_.size());
        double share = samples / static_cast<double>(plan_.settings.spp);
        if (options_.time_limit_s) share = std::max(share, seconds_since(start_) / *options_.time_limit_s);
        if (options_.error_target && last_error_) {
            const std::uint32_t checked = statistics_.samples / kErrorCheckEvery * kErrorCheckEvery;
            const double ratio = *options_.error_target / *last_error_;
            share = std::max(share, samples / checked * ratio * ratio);
        }
        return std::min(share, 1.0);
    }

    const RenderOptions& options_;
    const RenderPlan& plan_;
    gpu::FrameParams params_;
    Executor executor_;
    SliceGovernor governor_;
    RowSamples row_samples_;
    Clock::time_point start_;
    RenderStatistics statistics_;
    std::optional<double> last_error_;
    std::uint32_t sample_ = 0;
    FrameState state_;
};

void measure_process(RenderStatistics& statistics) {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    statistics.cpu_s = seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime);
    statistics.peak_rss_mib = static_cast<double>(usage.ru_maxrss) / 1024.0;
}

// Local coordinates of a scene without voxels are counted from its point nearest to the camera, so that even
// the top of a sphere of radius 10^6 keeps its precision where it is seen.
glm::ivec3 nearest_to_camera(const Scene& scene) {
    const Box box = scene_bounds(scene);
    if (box.empty()) return glm::ivec3(0);
    return glm::ivec3(
        glm::clamp(glm::floor(camera_of(scene).position), glm::dvec3(box.lo), glm::dvec3(box.hi)));
}

void warn_about_camera(const Scene& scene, const PreparedScene& prepared,
                       std::vector<std::string>& warnings) {
    const MarchWorld& march_world = prepared.march_world;
    const glm::ivec3 cell(glm::floor(camera_of(scene).position - glm::dvec3(march_world.origin)));
    if (!prepared.facts.has_voxels || gpu::is_outside(cell, march_world.size())) return;
    if (gpu::cell_state(gpu::find_cell(march_world, cell, march_world.chunks_size).cell) == gpu::kCellSolid)
        warnings.push_back("the camera is inside a solid voxel: the picture shows its inside, which is dark");
}

}  // namespace

PreparedScene prepare_scene(const Scene& scene, const PlanRequest& request, const DeviceLimits& limits) {
    PreparedScene prepared{.facts = measure_scene(scene)};
    TraversalChoice choice;
    if (prepared.facts.has_voxels) {
        const VoxelWorld world = build_world(scene);
        choice = choose_traversal(take_census(world), request.traversal, request.memory_budget_bytes, limits);
        prepared.march_world = build_march_skeleton(world, choice.traversal);
    } else {
        prepared.march_world.origin = nearest_to_camera(scene);
        prepared.march_world.roots = {0};
    }
    WorldFacts world_facts = measure_world(prepared.march_world);
    world_facts.traversal_reason = choice.reason;
    prepared.plan = plan_render(scene, prepared.facts, world_facts, request, limits);
    return prepared;
}

RenderOutcome render_scene(const Scene& scene, const RenderOptions& options,
                           const std::function<void(const Progress&)>& on_progress) {
    const Clock::time_point start = options.started;
    Device device = open_device(options.device);
    const PreparedScene prepared = prepare_scene(scene, options.plan, device.limits());
    const double load_s = seconds_since(start);
    RenderOutcome outcome{.plan = prepared.plan};
    {
        RenderRun run(scene, prepared, options, device, start);
        run.run(on_progress);
        outcome.statistics = run.finish(outcome.image);
    }
    RenderStatistics& statistics = outcome.statistics;
    statistics.device = device.info();
    statistics.load_s = load_s;
    statistics.validation = device.messages();
    statistics.warnings = scene.warnings;
    warn_about_camera(scene, prepared, statistics.warnings);
    statistics.wall_s = seconds_since(start);
    measure_process(statistics);
    return outcome;
}

}  // namespace voxilux
