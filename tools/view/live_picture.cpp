#include "view/live_picture.h"

#include <algorithm>

#include "base/clock.h"

namespace voxilux {
namespace {

// Frames without a change after which the picture counts as at rest.
constexpr int kRestFrames = 5;
// Frames of a motion, as far as the plan is concerned: as many as make sharing worth while.
constexpr std::uint32_t kMotionFrames = 1000;

}  // namespace

void LivePicture::load(const Scene& scene, const PlanRequest& request) {
    if (measure_scene(scene).has_voxels)
        renderer_.prepare_editable(scene, request);
    else
        renderer_.prepare(scene, request);
    settings_ = scene.settings;
    request_ = request;
    moving_frames_ = 0;
    forget();
}

void LivePicture::set_camera(const Camera& camera) {
    begin_motion();
    renderer_.set_camera(camera);
}

void LivePicture::set_size(glm::ivec2 size) {
    settings_.size = size;
    if (is_moving())
        apply_motion();
    else
        change(settings_, request_);
}

void LivePicture::change(const RenderSettings& settings, const PlanRequest& request) {
    renderer_.change(settings, request);
    settings_ = settings;
    request_ = request;
    moving_frames_ = 0;
    forget();
}

void LivePicture::edit(std::span<const BoxEdit> edits) {
    begin_motion();
    renderer_.edit(edits);
}

void LivePicture::begin_motion() {
    if (!is_moving()) apply_motion();
    moving_frames_ = kRestFrames;
}

// The same scene, coarser, and with what frames can share.
void LivePicture::apply_motion() {
    RenderSettings settings = settings_;
    settings.size = resolution_.size_in(settings_.size);
    PlanRequest request = request_;
    request.effects.wants_aov = false;
    request.frames = kMotionFrames;
    renderer_.change(settings, request);
}

void LivePicture::end_motion() {
    renderer_.change(settings_, request_);
    forget();
}

void LivePicture::forget() {
    passes_.clear();
}

bool LivePicture::is_done() const {
    return !is_moving() && samples() >= max_samples_;
}

LiveFrame LivePicture::advance(double budget_s, std::uint32_t end_samples) {
    const auto start = std::chrono::steady_clock::now();
    if (is_moving() && --moving_frames_ == 0) end_motion();
    LiveFrame frame{.size = renderer_.plan().settings.size};
    if (is_moving()) {
        const std::uint32_t before = samples();
        while (samples() == before)
            (void)renderer_.step(budget_s, before + 1);
        frame.step_s = seconds_since(start);
        if (resolution_.learn(frame.step_s)) apply_motion();
        frame.samples = before + 1;
        return frame;
    }
    const std::uint32_t end = std::min(end_samples, max_samples_);
    if (samples() < end) {
        const StepResult step = renderer_.step(budget_s, end);
        add_times(passes_, step.passes);
    }
    frame.samples = samples();
    frame.step_s = seconds_since(start);
    return frame;
}

DisplayBuffer LivePicture::display() {
    if (samples() > 0) shown_ = renderer_.display();
    return shown_;
}

}  // namespace voxilux
