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

// What ends the samples of a picture at rest, besides their number.
struct SampleEnds {
    std::optional<double> error;  // root of relMSE; if given, the number of samples is not limited
    std::optional<double> time_limit_s;
};

// What a frame of the window did.
struct LiveFrame {
    glm::ivec2 size{0};             // of the rendered picture
    std::uint32_t samples = 0;      // in its film
    double step_s = 0.0;            // spent in the renderer
    std::vector<StepTime> built{};  // what making, editing and uploading worlds took before its first step
};

// The picture of a window: a scene, a camera and a size, each of which may change at any time. While
// something changes, it is as coarse as the frame time demands, shares occlusion between frames and leaves
// out indirect light. At rest it becomes the picture of `voxilux render`, sample by sample.
class LivePicture {
  public:
    LivePicture(Device& device, const ExecutorOptions& options) : renderer_(device, options) {}

    // Shows another scene, which has a camera; its settings have the size. Throws as Renderer::prepare, and
    // keeps the old scene then.
    void load(const Scene& scene, const PlanRequest& request);
    // Throws as Renderer::set_camera, and keeps the old camera then.
    void set_camera(const Camera& camera);
    // Throws as Renderer::set_sun, and keeps the old sun then.
    void set_sun(const Sun& sun);
    void set_size(glm::ivec2 size);
    // Shows a frame of an animation, which has other voxels or another sun. Its voxels cannot be edited.
    void set_frame(const Scene& still);
    void change(const RenderSettings& settings, const PlanRequest& request);
    // Returns the edits that undo these.
    std::vector<BoxEdit> edit(std::span<const BoxEdit> edits);
    void set_max_samples(std::uint32_t samples) { max_samples_ = samples; }
    void set_ends(const SampleEnds& ends);

    // Takes samples for about `budget_s`; at rest until there are `end_samples` whole ones, or all.
    LiveFrame advance(double budget_s, std::uint32_t end_samples = kNoEnd);

    // What there is to show: the picture of the last whole sample; size 0 before the first.
    [[nodiscard]] DisplayBuffer display(const DisplayLook& look);
    // Whether a sample has ended since the last display().
    [[nodiscard]] bool has_news() const { return has_news_; }

    // The image to compare with. It is shown while the picture has the same size. Throws Error(input_refused)
    // for an image without colours.
    void set_reference(Image image);
    // FLIP of the picture at rest against the reference; computed only while it is shown.
    [[nodiscard]] const FlipMap& flip() const { return flip_; }
    // Whether advance() waits for other threads, so that scripts give the same pictures each time.
    void set_waits(bool waits) { waits_ = waits; }

    // The mean and the error of a pixel, and the value of a channel there, from the film at rest. Empty while
    // something moves or before the first sample.
    [[nodiscard]] std::optional<PixelReading> read_pixel(glm::ivec2 pixel, DisplayChannel channel);

    [[nodiscard]] bool is_loaded() const { return renderer_.is_prepared(); }
    [[nodiscard]] bool is_moving() const { return moving_frames_ > 0; }
    [[nodiscard]] bool is_done() const;
    [[nodiscard]] std::uint32_t samples() const { return renderer_.film().position().samples; }
    [[nodiscard]] std::uint32_t max_samples() const { return ends_.error ? kMaxSamples : max_samples_; }
    // The next three are those of the picture at rest.
    [[nodiscard]] const Camera& camera() const { return camera_; }
    [[nodiscard]] const RenderSettings& settings() const { return settings_; }
    [[nodiscard]] const PlanRequest& request() const { return request_; }
    // Errors that the film at rest was estimated to have so far.
    [[nodiscard]] const LiveErrors& errors() const { return errors_; }
    // Times of the passes and what the device counted since the picture was changed.
    [[nodiscard]] const RenderStatistics& statistics() const { return statistics_; }
    [[nodiscard]] Renderer& renderer() { return renderer_; }
    // The plan of the picture at rest; before its first one, that of the motion.
    [[nodiscard]] const RenderPlan& rest_plan() const { return rest_plan_ ? *rest_plan_ : renderer_.plan(); }
    [[nodiscard]] const Executor& executor() { return renderer_.executor(); }

    // Sets the time that the samples of a frame may take while something moves.
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
    int moving_frames_ = 0;  // frames until the picture counts as at rest; 0: it is at rest
    DisplayBuffer shown_;
    DisplayLook shown_look_;
    bool has_news_ = false;
    bool has_other_size_ = false;   // the motion needs another resolution
    std::vector<float> reference_;  // [height][width][3]
    glm::ivec2 reference_size_{0};
    Image reference_image_;
    FlipMap flip_;
    bool waits_ = false;
    DisplayComparison sent_ = DisplayComparison::none;  // what the device holds: the reference or the map
    RenderStatistics statistics_;
};

}  // namespace voxilux
