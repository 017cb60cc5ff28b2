#include "view/live_picture.h"

#include <algorithm>

#include "base/clock.h"

namespace voxilux {
namespace {

// Frames without a change after which the picture counts as at rest.
constexpr int kRestFrames = 5;
// Frames of a motion, as far as the plan is concerned: as many as make sharing worth while.
constexpr std::uint32_t kMotionFrames = 1000;

RenderSettings moving(RenderSettings settings, const Resolution& resolution) {
    settings.size = resolution.size_in(settings.size);
    return settings;
}

// Occlusion stands in for indirect light, and frames can share it.
PlanRequest moving(PlanRequest request) {
    request.frames = kMotionFrames;
    request.effects.switches[Effect::indirect] = Switch::off;
    request.effects.switches[Effect::caustics] = Switch::off;
    return request;
}

}  // namespace

void LivePicture::load(const Scene& scene, const PlanRequest& request) {
    Scene coarse = scene;
    coarse.settings = moving(scene.settings, resolution_);
    if (measure_scene(scene).has_voxels)
        renderer_.prepare_editable(coarse, moving(request));
    else
        renderer_.prepare(coarse, moving(request));
    settings_ = scene.settings;
    request_ = request;
    resolution_.start();
    moving_frames_ = kRestFrames;
}

void LivePicture::set_camera(const Camera& camera) {
    begin_motion();
    renderer_.set_camera(camera);
}

void LivePicture::set_size(glm::ivec2 size) {
    settings_.size = size;
    apply_motion();
}

void LivePicture::change(const RenderSettings& settings, const PlanRequest& request) {
    renderer_.change(settings, request);  // throws where the picture at rest cannot be
    settings_ = settings;
    request_ = request;
    apply_motion();
}

void LivePicture::edit(std::span<const BoxEdit> edits) {
    begin_motion();
    renderer_.edit(edits);
}

void LivePicture::begin_motion() {
    if (!is_moving()) apply_motion();
    moving_frames_ = kRestFrames;
}

void LivePicture::apply_motion() {
    replan_motion();
    moving_frames_ = kRestFrames;
}

// The same scene, coarser, and with what frames can share.
void LivePicture::replan_motion() {
    renderer_.change(moving(settings_, resolution_), moving(request_));
    resolution_.start();
}

void LivePicture::end_motion() {
    renderer_.change(settings_, request_);
    passes_.clear();
}

bool LivePicture::is_done() const {
    return !is_moving() && samples() >= max_samples_;
}

LiveFrame LivePicture::advance(double budget_s, std::uint32_t end_samples) {
    if (is_moving() && --moving_frames_ == 0) end_motion();
    if (is_moving()) return advance_motion(budget_s);
    const auto start = std::chrono::steady_clock::now();
    const std::uint32_t end = std::min(end_samples, max_samples_);
    if (samples() < end) {
        const StepResult step = renderer_.step(budget_s, end);
        add_times(passes_, step.passes);
        has_news_ |= step.samples > 0;
    }
    return {renderer_.plan().settings.size, samples(), seconds_since(start)};
}

// One whole sample, however long it takes.
LiveFrame LivePicture::advance_motion(double budget_s) {
    // Not before the frame that it was learnt from is shown.
    if (std::exchange(has_other_size_, false)) replan_motion();
    const auto start = std::chrono::steady_clock::now();
    const std::uint32_t before = samples();
    while (samples() == before)
        (void)renderer_.step(budget_s, before + 1);
    has_news_ = true;
    const LiveFrame frame{renderer_.plan().settings.size, samples(), seconds_since(start)};
    has_other_size_ = resolution_.learn(frame.step_s);
    return frame;
}

DisplayBuffer LivePicture::display(const DisplayLook& look) {
    const bool is_new = std::exchange(has_news_, false) || look != shown_look_;
    if (samples() > 0 && is_new) {
        shown_look_ = look;
        DisplayLook shown = look;
        if (!has_channel(renderer_.plan(), look.channel)) shown.channel = DisplayChannel::color;
        shown_ = renderer_.display(shown);
    }
    return shown_;
}

}  // namespace voxilux
