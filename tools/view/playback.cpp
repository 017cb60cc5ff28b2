#include "view/playback.h"

namespace voxilux {
namespace {

constexpr double kFrame_s = 1.0 / 24.0;

}  // namespace

void Playback::load(const Scene& scene, std::int64_t frame, ViewState& state) {
    player_.reset();
    state.is_playing = false;
    state.frames = frames_of(scene);
    if (!state.frames) return;
    state.frame = shown_ = frame;
    player_.emplace(scene);
    (void)player_->show(frame);
}

void Playback::advance(double seconds, ViewState& state) {
    if (!player_) return;
    left_s_ = state.is_playing ? left_s_ - seconds : kFrame_s;
    if (left_s_ <= 0.0) {
        left_s_ = kFrame_s;
        state.frame = state.frame < state.frames->last ? state.frame + 1 : state.frames->first;
    }
    if (state.frame == shown_) return;
    shown_ = state.frame;
    const Scene& still = player_->show(shown_);
    if (player_->has_new_voxels()) state.picture.set_voxels(still);
    if (still.camera) state.view = view_of(*still.camera, state.box);
}

}  // namespace voxilux
