#pragma once

#include <chrono>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "jobs/live_errors.h"
#include "jobs/render_outcome.h"
#include "renderer/renderer.h"
#include "view/flip_map.h"
#include "view/pixel_reading.h"
#include "view/resolution.h"

namespace voxilux {

// What ends the samples of a picture at rest, beside their number.
struct SampleEnds {
    std::optional<double> error;  // root of relMSE; then their number ends nothing
    std::optional<double> time_limit_s;
};

// What a frame of the window did.
struct LiveFrame {
    glm::ivec2 size{0};         // of the picture that was rendered
    std::uint32_t samples = 0;  // that its film has
    double step_s = 0.0;        // in the renderer
};

// The picture of a window: a scene, a camera and a size that change at any time. When something changes it is
// as coarse as the frame time wants, shares occlusion between frames and leaves out indirect light; at rest
// it is the picture that `voxilux render` makes, sample by sample.
class LivePicture {
  public:
    LivePicture(Device& device, const ExecutorOptions& options) : renderer_(device, options) {}

    // Another scene, with a camera; its settings name the size. Throws as Renderer::prepare; then the old one
    // stays.
    void load(const Scene& scene, const PlanRequest& request);
    // Throws as Renderer::set_camera; then the old one stays.
    void set_camera(const Camera& camera);
    void set_size(glm::ivec2 size);
    // A frame of an animation, whose voxels or light are others; its voxels cannot be edited.
    void set_frame(const Scene& still);
    void change(const RenderSettings& settings, const PlanRequest& request);
    // Returns the edits that take it back.
    std::vector<BoxEdit> edit(std::span<const BoxEdit> edits);
    void set_max_samples(std::uint32_t samples) { max_samples_ = samples; }
    void set_ends(const SampleEnds& ends);

    // Takes samples for about so long, at rest until there are `end_samples` whole ones, or all.
    LiveFrame advance(double budget_s, std::uint32_t end_samples = kNoEnd);

    // What there is to show: the picture of the last whole sample; size 0 before the first.
    [[nodiscard]] DisplayBuffer display(const DisplayLook& look);
    // Whether a sample has ended since the last display().
    [[nodiscard]] bool has_news() const { return has_news_; }

    // What to compare with. It is shown where the picture has its size. Throws Error(input_refused) for an
    // image without colours.
    void set_reference(Image image);
    // FLIP of the picture at rest against it, while the looks that are shown want it.
    [[nodiscard]] const FlipMap& flip() const { return flip_; }
    // Whether advance() waits for what other threads compute, so that it does the same again.
    void set_waits(bool waits) { waits_ = waits; }

    // What the film at rest knows of a pixel and of a channel; nothing while something moves or before the
    // first sample.
    [[nodiscard]] std::optional<PixelReading> read_pixel(glm::ivec2 pixel, DisplayChannel channel);

    [[nodiscard]] bool is_loaded() const { return renderer_.is_prepared(); }
    [[nodiscard]] bool is_moving() const { return moving_frames_ > 0; }
    [[nodiscard]] bool is_done() const;
    [[nodiscard]] std::uint32_t samples() const { return renderer_.film().position().samples; }
    [[nodiscard]] std::uint32_t max_samples() const { return ends_.error ? kMaxSamples : max_samples_; }
    // Of the picture at rest.
    [[nodiscard]] const Camera& camera() const { return camera_; }
    [[nodiscard]] const RenderSettings& settings() const { return settings_; }
    [[nodiscard]] const PlanRequest& request() const { return request_; }
    // What the film at rest has claimed so far.
    [[nodiscard]] const LiveErrors& errors() const { return errors_; }
    // Times of the passes and what the device counted since the picture was changed.
    [[nodiscard]] const RenderStatistics& statistics() const { return statistics_; }
    [[nodiscard]] Renderer& renderer() { return renderer_; }
    // Of the picture at rest, as far as it was made.
    [[nodiscard]] const RenderPlan& rest_plan() const { return rest_plan_ ? *rest_plan_ : renderer_.plan(); }
    [[nodiscard]] const Executor& executor() { return renderer_.executor(); }

    // What the samples of a frame may take while something moves.
    void set_motion_budget(double seconds) { resolution_.set_budget(seconds); }

  private:
    void fit_camera();
    void begin_motion();
    void apply_motion();
    void replan_motion();
    void end_motion();
    void take_samples(double budget_s, std::uint32_t end_samples);
    LiveFrame advance_motion(double budget_s);
    void compute_flip();
    [[nodiscard]] bool is_reference_of(glm::ivec2 size) const;
    void send_reference(DisplayComparison comparison);

    Renderer renderer_;
    RenderSettings settings_;
    Camera camera_;  // of the picture at rest
    PlanRequest request_;
    std::optional<RenderPlan> rest_plan_;
    Resolution resolution_;
    std::uint32_t max_samples_ = 1;
    SampleEnds ends_;
    LiveErrors errors_;
    int moving_frames_ = 0;  // until the picture counts as at rest; 0: it is
    DisplayBuffer shown_;
    DisplayLook shown_look_;
    bool has_news_ = false;
    bool has_other_size_ = false;   // the resolution of a motion
    std::vector<float> reference_;  // [height][width][3]
    glm::ivec2 reference_size_{0};
    Image reference_image_;
    FlipMap flip_;
    bool waits_ = false;
    DisplayComparison sent_ = DisplayComparison::none;  // to the device: the reference or the map
    RenderStatistics statistics_;
};

}  // namespace voxilux
