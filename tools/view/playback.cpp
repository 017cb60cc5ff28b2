#include "view/playback.h"

namespace voxilux {
namespace {

constexpr double kFrame_s = 1.0 / 24.0;

}  // namespace

const Scene& Playback::load(const Scene& scene, std::int64_t frame) {
    frames_ = frames_of(scene);
    shown_ = frame;
    if (!frames_) return scene;
    const Animation& animation = scene.animation;
    const bool has_path = !animation.camera_keys.empty();
    const bool has_turntable = !has_path && animation.turntable;
    moves_camera_ = has_path || (has_turntable && animation.turntable->turned != Turned::light);
    turns_sun_ = has_turntable && animation.turntable->turned != Turned::camera;
    player_.emplace(scene);
    return player_->show(frame);
}

void Playback::start(ViewState& state) const {
    state.frames = frames_;
    state.frame = shown_;
    state.is_playing = false;
    state.turns_sun = turns_sun_;
}

void Playback::advance(double seconds, ViewState& state) {
    if (!player_) return;
    left_s_ = state.is_playing ? left_s_ - seconds : kFrame_s;
    if (left_s_ <= 0.0) {
        left_s_ = kFrame_s;
        state.frame = state.frame < state.frames->last ? state.frame + 1 : state.frames->first;
    }
    if (state.frame != shown_) show(state.frame, state);
}

void Playback::show(std::int64_t frame, ViewState& state) {
    shown_ = frame;
    const Scene& still = player_->show(frame);
    if (player_->has_new_voxels() || player_->has_new_light()) {
        state.picture.set_frame(still);
        if (is_unsaved(state.edit)) state.message = "another frame: the edits are gone";
        forget_edits(state.edit);
    }
    // Where the animation leaves the camera alone, it stays where somebody put it.
    if (moves_camera_) state.view = view_of(*still.camera, state.box);
}

}  // namespace voxilux
