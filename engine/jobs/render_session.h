#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "estimators/error_estimate.h"
#include "film/film_sums.h"
#include "formats/image.h"
#include "frame/frame_state.h"
#include "jobs/error_rounds.h"
#include "jobs/forecast.h"
#include "jobs/next_minute.h"
#include "plan/render_plan.h"
#include "renderer/prepared_scene.h"
#include "scene/animation.h"
#include "scene/scene.h"
#include "vk/device.h"
#include "vk/executor.h"

namespace voxilux {

// What a film holds before its first sample: that of a checkpoint, or nothing.
struct FilmStart {
    FilmSums sums;                 // no planes: an empty film
    std::uint32_t samples = 0;     // whole ones, of the shard
    std::uint32_t rows_ahead = 0;  // rows from the top that have one more
    std::map<std::string, std::uint64_t> work;
    std::map<std::string, std::uint64_t> faults;
};

struct RenderOutcome;

struct RenderOptions {
    PlanRequest plan;
    DeviceRequest device;
    ExecutorOptions executor;
    std::optional<double> time_limit_s;  // of render_scene; a whole first sample is finished all the same
    std::optional<double> error_target;  // stop when the error estimate is below; relative, 0.01 is 1 %
    const std::atomic<bool>* interrupted = nullptr;
    // The film that the frame of this plan goes on from, asked once per frame; a new one when there is none.
    std::function<FilmStart(const Scene&, const RenderPlan&)> resume;
    // Gets what is rendered so far, as if the render ended now.
    std::function<void(const Scene&, RenderOutcome)> on_checkpoint;
    // With a time limit: gets a strip of the picture and does to it what will be done to the picture at the
    // end, without leaving anything behind. How long that takes is what the limit has to leave room for.
    std::function<void(const Scene&, RenderOutcome strip)> rehearse_end;
    double checkpoint_s = 0.0;  // from one checkpoint to the next; 0: none
    bool keeps_film = false;    // outcomes have the film, for parts and checkpoints
    // From when times count, those of the report and the time limit: the loading of the scene may be part of
    // it.
    std::chrono::steady_clock::time_point started = std::chrono::steady_clock::now();
};

struct Progress {
    double done = 0.0;  // [0,1], by whatever is expected to end the render first
    double elapsed_s = 0.0;
    double remaining_s = 0.0;  // at the pace so far
    double remaining_low_s = 0.0, remaining_high_s = 0.0;
    std::uint32_t sample = 0;
    std::optional<double> error;         // what the picture would claim now: the upper end of its interval
    std::optional<double> error_at_end;  // expected
    std::uint32_t frame = 0;             // which of `frames`, from 1; 0 when there is but one picture
    std::uint32_t frames = 0;
};

enum class StopReason : std::uint8_t { finished, error_target, time_limit, interrupted };

// What a render did: the numbers of the report.
struct RenderStatistics {
    DeviceInfo device;
    double wall_s = 0.0;
    double cpu_s = 0.0;
    double peak_rss_mib = 0.0;
    double load_s = 0.0;  // scene, world and structure, on the CPU
    double first_pixel_s =
        0.0;  // from RenderOptions::started to the end of the first slice; 0 when there is none
    double gpu_ms = 0.0;
    std::vector<PassTime> passes;
    std::map<std::string, std::uint64_t> work;
    std::map<std::string, std::uint64_t> faults;
    std::vector<MemoryRow> memory;
    std::uint64_t pipelines = 0;
    std::uint32_t samples = 0;     // whole ones, of the shard
    std::uint64_t live_cells = 0;  // of occlusion, at the end
    ErrorEstimate error;
    std::uint32_t rounds = 0;  // after which the error was compared with its target; 0: there is none
    DecidedBy decided_by = DecidedBy::request;
    std::optional<Forecast> forecast;       // made by a pilot
    std::optional<NextMinute> next_minute;  // nothing where the error is unknown
    StopReason stop = StopReason::finished;
    std::vector<std::string> warnings;
    std::vector<std::string> validation;  // messages of the layers
};

struct RenderOutcome {
    Image image;
    RenderPlan plan;
    RenderStatistics statistics;
    std::optional<FilmSums> film;  // see RenderOptions::keeps_film
    std::uint32_t rows_ahead = 0;  // rows from the top that have one sample more than statistics.samples
};

// Renders one frame of a scene after the other. The device, its pipelines and buffers are kept from frame to
// frame, and the world as long as its voxels are the same.
class RenderSession {
  public:
    // Opens the device. Throws Error(no_device).
    RenderSession(Scene scene, RenderOptions options);
    RenderSession(const RenderSession&) = delete;
    RenderSession& operator=(const RenderSession&) = delete;
    ~RenderSession();

    // The picture of `frame`: with brute-force occlusion the one that a session for this frame alone gives.
    // Always a whole picture; a pixel that no sample reached (only after an interruption) is black with
    // sampleCount 0. Times count from RenderOptions::started for the first frame, from the call for the
    // others.
    [[nodiscard]] RenderOutcome render(std::int64_t frame, std::optional<double> time_limit_s,
                                       const std::function<void(const Progress&)>& on_progress = {});

    // Only the pilot of `frame`, for the error target of the options. Nothing where none can be: shared
    // occlusion, or radii that depend on samples before.
    [[nodiscard]] std::optional<ErrorPilot> pilot(std::int64_t frame);

    // The plan of the frame last worked on.
    [[nodiscard]] const RenderPlan& plan() const { return prepared_->plan; }

    // The frames from now on have these settings and this plan, as in a session of their own; device,
    // pipelines and voxels are kept. So the structure of the world stays, whichever `request` names.
    void change(const RenderSettings& settings, const PlanRequest& request);

    // The still scene of the frame rendered last.
    [[nodiscard]] const Scene& scene() const { return *scene_; }

    // Gives the buffers and pipelines back; returns what the layers say of that. No frame may follow.
    [[nodiscard]] std::vector<std::string> end();

  private:
    [[nodiscard]] bool update_world(const Scene& scene);
    [[nodiscard]] Recording prepare(const Scene& scene);
    void replan(const Scene& scene, Recording& upload);
    void choose_radius(const Recording& upload);
    [[nodiscard]] std::optional<ErrorPilot> run_pilot(Recording& upload, const std::function<bool()>& stops);
    [[nodiscard]] ErrorGuess guess_error(Recording& upload, const RenderOptions& options,
                                         std::uint32_t samples_done,
                                         std::chrono::steady_clock::time_point start);
    void complete(RenderOutcome& outcome, double load_s, std::chrono::steady_clock::time_point start);
    [[nodiscard]] std::vector<std::string> new_messages();

    RenderOptions options_;
    FramePlayer player_;
    Device device_;
    std::optional<Executor> executor_;
    std::optional<PreparedScene> prepared_;  // of the world on the device
    FrameState state_;
    const Scene* scene_ = nullptr;
    std::vector<ErrorPoint> last_points_;  // of the frame before, with an error target
    std::optional<Forecast> forecast_;     // of the first frame
    std::vector<NoiseShare> shares_;
    std::optional<double> first_radius_;  // of photons, once a pilot has found it
    std::size_t messages_told_ = 0;
    bool has_started_ = false;
    bool is_changed_ = false;  // settings or request, since the last plan
};

// The picture of a scene, of an animated one that of its first frame.
[[nodiscard]] RenderOutcome render_scene(const Scene& scene, const RenderOptions& options,
                                         const std::function<void(const Progress&)>& on_progress = {});

}  // namespace voxilux
