#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "jobs/render_options.h"
#include "renderer/renderer.h"
#include "scene/animation.h"

namespace voxilux {

// Renders frames of a scene one after the other. The device, its pipelines and buffers are kept from frame to
// frame, and the world as long as its voxels do not change.
class RenderSession {
  public:
    // Opens the device. Throws Error(no_device).
    RenderSession(Scene scene, RenderOptions options);
    RenderSession(const RenderSession&) = delete;
    RenderSession& operator=(const RenderSession&) = delete;
    ~RenderSession();

    // The image of `frame`: with brute-force occlusion the same as from a session for this frame alone.
    // Always a whole image; a pixel without a sample (only after an interruption) is black with sampleCount
    // 0. Times count from RenderOptions::started for the first frame, from the call for the others.
    [[nodiscard]] RenderOutcome render(std::int64_t frame, std::optional<double> time_limit_s,
                                       const std::function<void(const Progress&)>& on_progress = {});

    // Only the pilot of `frame`, for the error target of the options. Nothing where a pilot is impossible:
    // shared occlusion, or radii that depend on earlier samples.
    [[nodiscard]] std::optional<ErrorPilot> pilot(std::int64_t frame);

    // The plan of `frame`, without rendering it.
    [[nodiscard]] const RenderPlan& plan_of(std::int64_t frame);

    [[nodiscard]] const DeviceInfo& device() const { return device_.info(); }

    // The plan of the frame last worked on.
    [[nodiscard]] const RenderPlan& plan() const { return renderer_->plan(); }

    // Later frames have these settings and this plan, as in a new session; device, pipelines and voxels are
    // kept, and therefore also the structure of the world, whichever `request` names.
    void change(const RenderSettings& settings, const PlanRequest& request);

    // Later frames are those of another scene, as in a new session; the device is kept.
    void load(Scene scene, const PlanRequest& request);

    // The still scene of the frame rendered last.
    [[nodiscard]] const Scene& scene() const { return *scene_; }

    // Frees buffers and pipelines and returns the messages of the validation layers. No frame may follow.
    [[nodiscard]] std::vector<std::string> end();

  private:
    void show(std::int64_t frame);
    [[nodiscard]] std::optional<ErrorPilot> run_pilot(const std::function<bool()>& stops);
    [[nodiscard]] ErrorPrior error_prior(const RenderOptions& options, std::uint32_t samples_done,
                                         std::chrono::steady_clock::time_point start);
    [[nodiscard]] bool denoises() const;
    [[nodiscard]] Denoised denoised(const FilmSums& film);
    [[nodiscard]] std::function<ErrorEstimate(const FilmSums&, const ErrorEstimate&)> claim_of_shown(
        std::vector<PassTime>& passes);
    void denoise(RenderOutcome& outcome);
    [[nodiscard]] std::uint64_t bytes_to_come();
    void complete(RenderOutcome& outcome, double load_s, std::chrono::steady_clock::time_point start);
    [[nodiscard]] std::vector<std::string> new_messages();

    RenderOptions options_;
    FramePlayer player_;
    Device device_;
    std::optional<Renderer> renderer_;
    const Scene* scene_ = nullptr;
    std::optional<std::vector<ErrorPoint>> last_points_;  // of the previous frame, since the last change
    std::optional<Forecast> forecast_;                    // of the first frame
    std::vector<NoiseShare> shares_;
    std::vector<StepTime> steps_before_;  // the frame
    std::size_t messages_told_ = 0;
    bool has_started_ = false;
    bool is_changed_ = false;  // settings or request, since the last frame
    bool is_loaded_ = true;    // a scene, likewise
};

// The image of a scene; of an animated one, its first frame.
[[nodiscard]] RenderOutcome render_scene(const Scene& scene, const RenderOptions& options,
                                         const std::function<void(const Progress&)>& on_progress = {});

}  // namespace voxilux
